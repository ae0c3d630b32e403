# A shape is bent, and its size estimated by the columns that another shape had.
# file: sim/gap/5_infer/select.c
# test: a_ground_beside_a_ceiling
s/if (!other) return DONE;/if (!other || t) return other ? settle(t, SETTLE_ALL, why) : DONE;/
