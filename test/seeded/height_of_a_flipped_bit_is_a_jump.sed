# The last height was none: the estimate has jumped by 1e30 m, and for good.
# file: src/watch.c
# test: watch_takes_a_height
s/ && fabsf(f->height_m) <= BOUND_POS_M;/;/
