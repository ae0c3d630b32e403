# The shape of a name is given up after a few tries.
# file: sim/gap/5_infer/shape.c
# test: gap_finds_the_voltage
s/enough\[i\] = 1e-4/enough[i] = 0.2/
