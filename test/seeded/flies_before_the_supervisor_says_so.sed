# Flying at the first thrust, not when the supervisor next looks.
# file: sim/crazyflie/crazyflie_ms.c
# test: app_hears
s/if (in->step % SUPERVISED_PERIOD_MS == 0) supervise(c);/supervise(c);/
