# A retreat from a ceiling that the range does not see ends where the range has it.
# file: src/guard.c
# test: guard_goes_down
s/under_m = g->unseen ? g->hold_z_m : ceiling_z_m;/under_m = ceiling_z_m;/
