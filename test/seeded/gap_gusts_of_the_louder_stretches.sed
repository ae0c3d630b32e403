# What sets in once is taken for a gust.
# file: sim/gap/3_feedback/stirs.c
# test: gap_reads_how_strong_gusts_are
s/nth_smallest(slow, n, (n - 1) \/ 2)/nth_smallest(slow, n, n - 1)/
