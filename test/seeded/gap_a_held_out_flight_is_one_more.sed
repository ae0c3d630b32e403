# What a held-out flight has all the time is more than can be named.
# file: sim/gap/8_report/warnings.c
# test: gap_says_that_the_held
s/squares > 0\.5 \*/squares > 50.0 */
