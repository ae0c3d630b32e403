# A ceiling comes down at once, through the vehicle.
# file: sim/drone/disturbed.c
# test: test_drone
s/m->ceiling_m = fmax(wanted_m, slow_m);/m->ceiling_m = wanted_m;(void)slow_m;/
