# Nominal pilots are not varied.
# file: sim/gap/3_feedback/nominal.h
# test: gap_nominal_pilots
s/^#define NOMINAL_VARIED 0\.3/#define NOMINAL_VARIED 0.0/
