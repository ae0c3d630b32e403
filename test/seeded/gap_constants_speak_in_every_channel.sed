# Of channels that a name does not act in constants speak against it.
# file: sim/gap/5_infer/local.c
# test: gap_asks_what_began
s/ww > 0.0 \&\& s->acts\[ch\] > 0.0/ww > 0.0/
