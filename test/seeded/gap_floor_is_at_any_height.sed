# What z says before take-off is the floor only at a height that the vehicle has.
# file: sim/gap/1_read/floor.c
# test: gap_counts_heights_from_where
s/return 2.0 \* (hypot/return 20.0 * (hypot/
