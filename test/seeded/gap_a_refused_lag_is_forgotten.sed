# What fits better in a name's place, and was refused for what feedback makes of it, is no rival.
# file: sim/gap/5_infer/family.c
# test: told_it_beside_a_delay
s/if (score_left(&r->score, with, NULL) < score_left/if (false \&\& score_left(\&r->score, with, NULL) < score_left/
