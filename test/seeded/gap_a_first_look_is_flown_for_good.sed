# What the first look takes noise for is flown nominally for good, and hides what is there.
# file: sim/gap/4_candidates/candidates.c
# test: what_was_flown_is_another
s/(!chosen_use(found, flown->of\[i\])) return/(!found) return/
