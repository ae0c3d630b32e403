# A shape keeps to its half of the way, though the names that came in later leave it another one.
# file: sim/gap/5_infer/select.c
# test: has_its_own_decay
s/? 1.0 : 0.5)/? 0.5 : 0.5)/
