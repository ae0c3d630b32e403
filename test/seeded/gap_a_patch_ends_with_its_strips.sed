# A patch of the floor is as wide as the strips that found it.
# file: sim/gap/5_infer/windows.c
# test: gap_finds_a_corner
s/for (bool moved = true; moved;)/for (bool moved = false; moved;)/
