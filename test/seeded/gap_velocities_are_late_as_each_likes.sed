# Flights whose velocities are moved by different times are taken without a word.
# file: sim/gap/8_report/warnings.c
# test: gap_says_that_the_velocities
s/most_s - least_s > MOVES_AGREE_S/most_s - least_s > 1e9/
