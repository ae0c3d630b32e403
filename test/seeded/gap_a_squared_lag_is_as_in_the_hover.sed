# In a replay rotors that follow with the square of their speed follow as in the hover at any speed.
# file: sim/gap/2_predict/grid_motors.c
# test: test_lag
s/const double l = fmax((1.0 - q) \/ tau_s + 2.0 \* b \* to, 1e-6);/const double l = 1.0 \/ tau_s;/
