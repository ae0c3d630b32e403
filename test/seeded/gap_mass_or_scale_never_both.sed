# Mass and thrust scale are never named beside each other, whatever the log holds.
# file: sim/gap/5_infer/round.c
# test: gap_tells_mass_from_thrust_scale_by_fast
s/ && r->turning_told);/ \&\& r->turning_told \&\& !r->s);/
