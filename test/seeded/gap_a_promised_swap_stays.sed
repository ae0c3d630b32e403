# A swap that the straight line promises stays, whether the models keep it or not.
# file: sim/gap/5_infer/select.c
# test: gap_gives_errors_that_hold_the_lateness
s/if (after < before) {/if (after < before || before > 0.0) {/
