# Places on both sides of a gap in time are one.
# file: sim/gap/2_predict/smooth.c
# test: gap_smooths_nothing_over_a_gap
s/g->point\[to\].segment == p->segment \&\& g->point\[to\].ok == p->ok/g->point[to].ok == p->ok/
