# What another name gives, too, has no rival any more.
# file: sim/gap/5_infer/family.c
# test: gap_takes_for_a_rival_what_is_alike_alone
s/if (!(most > SCORE_MOST/if (!(like > SCORE_MOST \&\& most > -1.0/
