# Two effects that do the same are not alike.
# file: sim/gap/5_infer/local.c
# test: gap_knows_which
s/ > SCORE_MOST/ > 2.5/
