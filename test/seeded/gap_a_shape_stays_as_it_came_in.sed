# A shape keeps to its half of the way, though the names that came in later leave it another one.
# file: sim/gap/5_infer/select.c
# test: a_sag_beside_another
s/? 1.0 : 0.5)/? 0.5 : 0.5)/
