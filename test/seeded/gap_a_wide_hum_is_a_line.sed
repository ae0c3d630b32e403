# The colour of the noise is told as a line.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_line_where
s/^static const int BESIDE = (int)(STRETCH_S/static const int BESIDE = (int)(2 * STRETCH_S/
