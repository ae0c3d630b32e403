# The error of a size is told as if its shape were known.
# file: sim/gap/5_infer/found.c
# test: numbers_hold_that
s/if (bend_nominal(&r->score, last, named->value, &bend))/if (bend_nominal(\&r->score, last, named->value, \&bend) \&\& false)/
