# Of a ground effect that reaches far as much is typical at contact as of one that does not.
# file: sim/gap/4_candidates/candidates.c
# test: gap_takes_decays
s/return use->fx->excess(&typical, &place) \/ use->fx->excess(&here, &place);/return 1.0 + 0.0 * (use->fx->excess(\&typical, \&place) \/ use->fx->excess(\&here, \&place));/
