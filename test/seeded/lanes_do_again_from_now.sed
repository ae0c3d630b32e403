# Who parts does its milliseconds again from what they made of it, in place of what was before.
# file: sim/flight/woven.c
# test: together
s/get_part_before(w, &w->now, k, &c->app);/(void)w;/
