# How the vehicle flies about is told as a line.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_line_where
s/^#define LOWEST    16/#define LOWEST    8/
