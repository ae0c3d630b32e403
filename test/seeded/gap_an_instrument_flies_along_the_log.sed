# What the pilots of the instrument follow is the log's own place, noise and all.
# file: sim/gap/2_predict/set_points.c
# test: set_points_make_a_track
s/track->point\[j\].seen_w_m = track->point\[j\].pos_w_m;/track->point[j].seen_w_m = g->point[j].seen_w_m;/
