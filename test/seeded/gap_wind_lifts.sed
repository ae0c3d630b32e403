# A wind that the rotors feel lifts a vehicle that leans into it.
# file: sim/effects/fx_wind.c
# test: wind_that_the_rotors_feel
s/d3(force_b_N.x, force_b_N.y, 0.0)/force_b_N/
