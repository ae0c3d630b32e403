# Turning counts by its increments, where a slow manoeuvre has none.
# file: sim/gap/5_infer/both_ways.c
# test: both_say
s/color_t color = color_fit(r, left)/color_t color = {1.0, 0.0, 1.0, left != room}/
