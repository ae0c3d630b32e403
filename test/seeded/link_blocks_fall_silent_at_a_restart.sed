# Log blocks wait for the clock of before.
# file: sim/link/link_logs.c
# test: test_drone
s/l->block\[i\].due_ms = firmware_now_ms(l->firmware) + l->block\[i\].period_ms;/(void)l;/
