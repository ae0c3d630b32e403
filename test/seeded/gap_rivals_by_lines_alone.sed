# Straight lines are believed to the last digit.
# file: sim/gap/5_infer/family.c
# test: gap_tells_nothing_apart
s/1.0 - like < CANDIDATES_MISFIT \* CANDIDATES_MISFIT/1.0 - like < 0.0/
