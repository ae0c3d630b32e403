# Where no nominal flight could be flown feedback is taken to make nothing.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/return j->nominal ? SELECT_LEAST \* c->/return j->nominal ? 1e-6 * c->/
