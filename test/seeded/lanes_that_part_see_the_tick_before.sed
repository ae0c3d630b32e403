# Sensors that part in the first millisecond of a tick read in the second what was true long ago.
# file: sim/flight/group_senses.c
# test: beside_others
/woven_get(&g->woven, LANES_truth, k, &f->truth);/d
