# What begins with a flight is told as a pulse.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_no_pulse
s/^#define SETTLED  25/#define SETTLED  2/
