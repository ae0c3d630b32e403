# A pulse of half a second is told as a shorter one.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_a_pulse_of
s/rows < ABOUT_S \* RESIDUAL_HZ/rows < 0.5 * ABOUT_S * RESIDUAL_HZ/
