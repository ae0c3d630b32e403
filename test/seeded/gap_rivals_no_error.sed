# What a rival makes of numbers is told as no error of them.
# file: sim/gap/5_infer/found.c
# test: gap_is_less_sure_of_a_number_that_goes
s/hypot(named->stderr_\[k\], named->by_rivals\[k\])/hypot(named->stderr_[k], 0.0)/
