# Of effects that leave the same the one with the most forms may be named: a weak rotor for a thrust scale.
# file: sim/gap/5_infer/round.c
# test: gap_names_of_effects_that_leave_the_same_the_one_with_fewest_forms
s/left += 2.0 \* log(candidates_of/left += 0.0 * log(candidates_of/
