# What lies in more than half of a coordinate is told as its absence in the rest.
# file: sim/gap/5_infer/windows_along.c
# test: gap_finds_the_window
s/return y_beside \* y_beside \* own > y \* y \* own_beside;/return y_beside * y_beside * own > HUGE_VAL;/
