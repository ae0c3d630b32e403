# A size that no channel shows keeps the others from being known.
# file: sim/gap/5_infer/score.c
# test: gap_score_goes_by_the_sizes
s/  if (!shown) return v;/  if (shown < c->n) return v;/
