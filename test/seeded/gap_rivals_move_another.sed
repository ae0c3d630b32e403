# The first number of a name is looked for at its place among the names.
# file: sim/gap/5_infer/family.c
# test: gap_is_less_sure_of_a_number_that_goes
s/== candidate) return first;/== candidate) return first > i ? i : first;/
