# Any other height ends a retreat from a ceiling that nobody sees.
# file: src/guard.c
# test: guard_ends_a_retreat
s/ && !(g->unseen && in->asked_z_m > in->pos_w_m.z)//
