# What pushes at one point says nothing of those beside it.
# file: sim/gap/2_predict/bumps.c
# test: gap_leaves_out_what_lies_beside_a_push
s/p->touches = p->touches || (p->clear_m < NEAR_M \&\& bumps);/if (p->ok \&\& p->clear_m < NEAR_M \&\& bumps) leave_out(g, m, p);/
