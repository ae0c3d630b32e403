# A line is compared with what its taper makes of it.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_line_where
s/^  OWN = 2,/  OWN = 0,/
