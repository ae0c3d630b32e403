# The errors of a height are taken for those of x.
# file: sim/gap/3_feedback/slow_errors.c
# test: gap_tells_the_errors
s/s->sum\[i\]\[k\] += miss\[i\]\[k\] \* miss\[i\]\[k\];/s->sum[i][k] += miss[i][0] * miss[i][0];/
