# Stock INDI, fault 5: the outer loop is not reset on the ground.
# file: src/flight.c
# test: flight
s/^    outer_rest(&f->outer);//; s/if (in->setpoint\.z == AXIS_OFF) {/if (false) {/
