# The first bins of a coordinate hold hardly a row.
# file: sim/gap/5_infer/windows_cut.c
# test: gap_bins_hold
s/(double)k \* (n - 1) \/ bins/(double)k * k * (n - 1) \/ bins \/ bins/
