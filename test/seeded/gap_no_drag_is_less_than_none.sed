# Of what the file has no estimate may lie beyond none.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/c->least\[k\] < 0.0 ? SCORE_ERRORS \* v->stderr_\[k\] : 0.0/0.0 * v->stderr_[k]/
