# A force upwards is tried in the kinds of the force along the floor, where it is the same.
# file: sim/gap/4_candidates/candidates.c
# test: numbers_that_have_other_rivals
s/of\.from > 0 ? 1 : fx->n_kind/fx->n_kind/
