# All nominal pilots are as sluggish as slow rows say.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_every_other_nominal_pilot_is_swift
s/if (w->unread \&\& i % 2) {/if (false \&\& i % 2) {/
