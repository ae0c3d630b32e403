# The own filter's climb is flown, and not its height.
# file: src/flight.c
# test: by_height
s/x->setpoint.pos_w_m.z -= f->height_fly.more_m/x->setpoint.pos_w_m.z -= 0.0f * f->height_fly.more_m/
