# Nobody is told what is left out of a held-out flight.
# file: sim/gap/8_report/unnamed.c
# test: gap_says_what_it_leaves_out
s/fabs(own) > LEFT_OVER \* p->floor/fabs(own) > 1e9 * p->floor/
