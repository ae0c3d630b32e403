# Rows of which nobody knows the commands may be in flight.
# file: sim/gap/1_read/floor.c
# test: gap_counts_heights_from_where
s/return isfinite(command) \&\& raw_flies/return command != 0.5 \&\& raw_flies/
