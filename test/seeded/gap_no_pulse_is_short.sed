# A pulse of two rows is told as a longer one.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_pulse_of
s/^#define SHORTEST 2/#define SHORTEST 4/
