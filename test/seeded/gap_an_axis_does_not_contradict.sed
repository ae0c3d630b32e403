# An inertia stands about one axis though another one contradicts it.
# file: sim/gap/5_infer/both_ways.c
# test: gap_takes_for_no_inertia
s/return borne_out && one;/return borne_out;/
