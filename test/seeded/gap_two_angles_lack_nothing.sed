# An attitude of which an angle lacks is left out without a word.
# file: sim/gap/1_read/read.c
# test: gap_says_which_angle
s/drop_part(f, raw, ANGLES);/(void)ANGLES;/
