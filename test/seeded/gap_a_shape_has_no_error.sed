# The shape of a name is told without its error.
# file: sim/gap/5_infer/shape.c
# test: gap_finds_a_ceilings_decay
s/hypot(robust \* p->unit\[SHAPE\] \* sqrt(inverse\[0\]), /hypot(0.0 * robust, 0.0 * /
