# What begins with a flight is told as a pulse.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_no_pulse
s/>= ABOUT_S \* RESIDUAL_HZ/>= 0.1 * ABOUT_S * RESIDUAL_HZ/
