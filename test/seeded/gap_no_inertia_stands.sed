# A scale is withdrawn that both ways bear out.
# file: sim/gap/5_infer/both_ways.c
# test: missed_commands_made
s/\*stands = \*stands || \(.*\) != 0.0;/*stands = \1 < 0.0;/
