# What nominal flights make of a size and its shape counts one that hardly comes there as much as one that does.
# file: sim/gap/5_infer/bend.c
# test: gap_s_errors_count_a_nominal_flight
s/score_rms(made\[k\], holds\[k\], flights)/score_rms(made[k], NULL, flights)/
