# What control makes of noise is taken for possible in numbers of the other sign, too.
# file: sim/gap/5_infer/information.c
# test: gap_information_takes_a_number
s/p->in_spite\[at\] = mean\[at\] \* p->g\[at\] < 0.0/p->in_spite[at] = mean[at] * p->g[at] < -HUGE_VAL/
