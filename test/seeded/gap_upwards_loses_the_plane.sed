# A force upwards takes the kind from the force along the floor.
# file: sim/gap/4_candidates/candidates.c
# test: gap_numbers_apart
s/own \&\& is_apart(use) ?/own \&\& is_apart(use) \&\& !own ?/
