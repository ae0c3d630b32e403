# The plant's rotors slow down with the square of their speed by the part that is of speeding up.
# file: sim/plant/rigid.h
# test: test_lag
s/r->lag_down_square \* faster/r->lag_up_square * faster/
