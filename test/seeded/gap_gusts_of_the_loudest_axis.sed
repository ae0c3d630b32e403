# What one axis alone has is taken for a gust of all.
# file: sim/gap/3_feedback/gusts.c
# test: gap_reads_how_strong_gusts_are
s/nth_smallest(of, n, (n - 1) \/ 2)/nth_smallest(of, n, n - 1)/
