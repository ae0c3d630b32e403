# A nominal pilot has the gain that commands against rates say.
# file: sim/gap/3_feedback/swiftness.c
# test: gap_finds_a_pilots_gain
s/if (gain > read) \*w =/if (gain < 0.0) *w =/
