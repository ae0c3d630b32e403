# A size that cannot be negative is named although it is.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/can_be(c, k, v->value\[k\], score_margin/can_be(c, k, fabs(v->value[k]), score_margin/
