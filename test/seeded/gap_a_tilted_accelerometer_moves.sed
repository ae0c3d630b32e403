# What an accelerometer errs by steadily is a movement where the vehicle turns.
# file: sim/gap/1_read/check.c
# test: gap_refuses_no_hover
s/if (drive != &GAP_PUSH) return true/if (drive) return true/
