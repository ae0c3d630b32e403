# How the vehicle flies about is told as a line.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_line_where
s/(int)(STRETCH_S \/ ABOUT_S)/(int)(0.5 * STRETCH_S \/ ABOUT_S)/
