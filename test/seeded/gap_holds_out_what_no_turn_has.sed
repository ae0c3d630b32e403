# A flight of a few seconds is held against itself, and noise is told to be a gap.
# file: sim/gap/5_infer/by_turns.c
# test: gap_cannot_tell_by_a_flight_too_short
s/longest_s >= TURNS \* BLOCK_S/longest_s >= BLOCK_S/
