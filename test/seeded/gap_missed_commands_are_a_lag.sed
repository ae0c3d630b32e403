# Rotor speeds tell a lag where commands are missed.
# file: sim/gap/5_infer/timing.c
# test: by_rotor_speeds
s/ || grid_misses_commands(&s->grid\[f\])//
