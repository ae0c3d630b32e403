# The size that would have been seen leaves out from where on the rows speak for it.
# file: sim/gap/5_infer/found.c
# test: gap_tells_the_least_size
s/^    need = fmax(need, speaks\[c->first + k\] \* typical);/    (void)speaks;/
