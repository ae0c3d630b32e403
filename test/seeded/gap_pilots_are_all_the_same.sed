# Nominal pilots are not varied.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_nominal_pilots
s/^#define VARIED    0\.3/#define VARIED    0.0/
