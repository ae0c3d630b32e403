# A range sensor that reads too little is at its floor before the vehicle is: those readings count.
# file: sim/gap/2_predict/grid.c
# test: a_range_bias_is_told_alone
s/fmin(above_m, p.range_m) < blind_m/above_m < blind_m/
