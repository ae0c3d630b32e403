# What lies beside a point that touches the floor is flight.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_a_landing
s/ || j < first || j > last))/))/
