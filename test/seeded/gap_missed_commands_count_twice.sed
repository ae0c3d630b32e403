# What missed commands make of a scale is an error of it beside the interval that holds it.
# file: sim/gap/5_infer/both_ways.c
# test: missed_commands_made
s/all \* all - beside \* beside/all * all - 0.0 * beside/
