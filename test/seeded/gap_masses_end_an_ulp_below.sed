# A number may end an ulp beyond what it can be.
# file: sim/gap/5_infer/round.c
# test: gap_takes_no_number_beyond
s/candidate_possible(c, k, value + share \* way)/value + share * way/
