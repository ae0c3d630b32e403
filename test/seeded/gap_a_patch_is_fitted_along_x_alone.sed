# The ends of a patch are fitted along one of its ways.
# file: sim/gap/5_infer/windows.c
# test: gap_finds_a_corner
s/moved = fit_ends(f, ch, false, &at) || along_x;/moved = fit_ends(f, ch, true, \&at) || along_x;/
