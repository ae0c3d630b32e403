# A set point that is no number is taken as the floor, and the thrust steps.
# file: src/watch.c
# test: faults_of_the_list
s/in->setpoint = f->setpoint;/in->setpoint = f->setpoint, in->setpoint.pos_w_m = (v3_t){0.0f, 0.0f, 0.0f};/
