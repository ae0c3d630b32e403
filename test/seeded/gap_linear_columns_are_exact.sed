# A large inertia is withdrawn, because linear columns tell it 1 % smaller than the two regressions do.
# file: sim/gap/5_infer/both_ways.c
# test: gap_takes_no_inertia_within_two
s/CANDIDATES_MISFIT \* (1\.0 + k)/0.0 * (1.0 + k)/
