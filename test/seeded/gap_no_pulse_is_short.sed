# A pulse of two rows is told as a longer one.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_pulse_of
s/int rows = FILTER_ROWS;/int rows = 2 * FILTER_ROWS;/
