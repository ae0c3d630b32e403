# A fault changes the app's memory as it was before its numbers went into lanes.
# file: sim/flight/group_pilots.c
# test: beside_others
s/woven_vehicle_home(&g->woven, at->k, g->job\[at->k\]->f);//
