# The colour of the noise is told as a line.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_line_where
s/^#define BESIDE    12/#define BESIDE    24/
