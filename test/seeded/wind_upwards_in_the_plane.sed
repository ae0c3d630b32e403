# Of a force upwards only the part in the rotors' plane acts.
# file: sim/effects/fx_wind.c
# test: wind_that_the_rotors_feel
s/plant->force_w_N\.z += p\[2\];/plant->force_w_N.z += (1.0 - p[8]) * p[2];/
