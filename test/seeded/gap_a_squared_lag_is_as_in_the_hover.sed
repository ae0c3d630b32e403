# In a replay rotors that follow with the square of their speed follow as in the hover at any speed.
# file: sim/gap/2_predict/grid_motors.c
# test: test_lag
s/l = not_zero(rate.a + 2.0 \* rate.b \* to);/l = 1.0 \/ lag->up_s;/
