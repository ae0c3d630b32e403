# A patch of the floor is as wide as the strips that found it.
# file: sim/gap/5_infer/windows.c
# test: gap_finds_a_corner
s/i < 2 \* TURNS;/i < 0 * TURNS;/
