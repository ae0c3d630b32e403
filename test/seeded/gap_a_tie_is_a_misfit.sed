# A place that alone would not be told is told in a tie.
# file: sim/gap/5_infer/unknown.c
# test: gap_tells_a_place_before
s/tied\[k\] = beyond(c, to->bound\[k\]) > 0.0/tied[k] = beyond(c, to->chance[k]) > 0.0/
