# The planner sets points while a client does.
# file: sim/crazyflie/commanded.c
# test: test_commanded
s/if (priority < c->priority) return;/(void)0;/
