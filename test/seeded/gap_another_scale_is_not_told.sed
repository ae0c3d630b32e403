# A scale of a tenth is passed over.
# file: sim/gap/1_read/check.c
# test: gap_tells_of_a_scale
s/^#define OTHER_SCALE 0.02/#define OTHER_SCALE 0.2/
