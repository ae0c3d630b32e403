# What the first look takes noise for is flown nominally for good, and hides what is there.
# file: sim/gap/diagnose.c
# test: gap_s_instrument_differs
s/(!chosen_use(found, flown->of\[i\])) return/(!found) return/
