# A nominal flight that hardly shows a number counts in a gate as one that shows it as the log does.
# file: sim/gap/5_infer/score.c
# test: gap_score_lets_in
s/^    for (int i = 0; i < flights; i++) value\[k\]\[i\] \*= sqrt(fmin(holds\[k\]\[i\] \/ log_holds, 1.0));/    (void)log_holds;/
