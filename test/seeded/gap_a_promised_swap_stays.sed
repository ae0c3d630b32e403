# A swap that the straight line promises stays, whether the models keep it or not.
# file: sim/gap/5_infer/select.c
# test: users_logs_are_given_a_bent_curve
s/if (after < before) {/if (after < before || before > 0.0) {/
