# Of what the file has no estimate may lie beyond none.
# file: sim/gap/5_infer/score.h
# test: gap_score_lets_in
s/c->in_file ? SCORE_ERRORS \* error/c->in_file ? 0.0 * error/
