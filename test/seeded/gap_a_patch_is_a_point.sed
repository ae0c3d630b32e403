# A patch may be as narrow as rows allow.
# file: sim/gap/5_infer/windows.c
# test: gap_patch_of_the_floor_is_no_narrower
s/bins, f->parts, MOST \* f->parts/bins, 1, MOST * f->parts/
