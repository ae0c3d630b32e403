# Nobody is told what is left out of a held-out flight.
# file: sim/gap/8_report/unnamed.c
# test: gap_says_what_it_leaves_out
s/LEFT_OVER \* fmax(p->after, p->floor)/1e9 * fmax(p->after, p->floor)/
