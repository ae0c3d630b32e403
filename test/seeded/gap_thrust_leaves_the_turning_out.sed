# A centre of mass that the file does not know makes a calm hover's turning unlike its commands.
# file: sim/gap/2_predict/excluded.c
# test: gap_leaves_out_no_turning
s/ && beside\[ch\].most < EXCLUDED_SLOPE//
