# Flying at the first thrust, not when the supervisor next looks.
# file: sim/crazyflie/crazyflie_ms.c
# test: app_hears
s/FOR_WHOM(in->step % SUPERVISED_PERIOD_MS == 0, &c->supervised) supervise(c);/supervise(c);/
