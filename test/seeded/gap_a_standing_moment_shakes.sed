# A moment that begins in a flight, and stays, is taken for a disturbance of the whole flight.
# file: sim/gap/3_feedback/stirs.c
# test: gap_takes_no_moment_that_begins
s/nth_smallest(room, changes, (changes - 1) \/ 2)/nth_smallest(room, changes, changes - 1)/
