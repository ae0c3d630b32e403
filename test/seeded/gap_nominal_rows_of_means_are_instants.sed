# Nominal flights along a log of means miss most commands.
# file: sim/gap/3_feedback/nominal_log.c
# test: gap_nominal_flights_shake
s/, \.rows_are_means = like->rows_are_means//
