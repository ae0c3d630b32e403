# A scale is withdrawn that both ways bear out.
# file: sim/gap/5_infer/both_ways.c
# test: missed_commands_made
s/borne_out = borne_out || \(.*\) != 0.0;/borne_out = \1 < 0.0;/
