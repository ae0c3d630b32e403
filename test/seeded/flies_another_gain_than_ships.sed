# A scenario that flies another gain than ships, and does not say so.
# file: sim/pilots/pilot_flight.c
# test: scenarios_fly_what_ships
s/^  p->param = \*param;/  p->param = *param; p->param.pos.kp_per_s *= 1.1f;/
