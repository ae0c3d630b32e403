# Stock INDI, fault 7: the velocity of a trajectory is dropped.
# file: src/flight.c
# test: flight_
s/return (pos_setpoint_t){pos, vel, sp->acc_w_mps2};/return (pos_setpoint_t){pos, sp->x == AXIS_POSITION ? (v3_t){0.0f, 0.0f, 0.0f} : vel, sp->acc_w_mps2};/
