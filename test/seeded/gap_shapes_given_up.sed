# The shape of a name is given up after a few tries.
# file: sim/gap/5_infer/shape.h
# test: gap_finds_the_voltage
s/^#define SHAPE_TRIES 100/#define SHAPE_TRIES 10/
