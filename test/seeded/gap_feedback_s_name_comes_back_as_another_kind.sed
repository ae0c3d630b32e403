# What feedback makes is named in another kind.
# file: sim/gap/4_candidates/candidates.c
# test: what_is_barred_is_barred
s/(!alone \&\& candidates_exclude/(alone \&\& candidates_exclude/
