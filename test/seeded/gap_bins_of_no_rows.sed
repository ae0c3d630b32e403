# The first bins of a coordinate hold hardly a row.
# file: sim/gap/5_infer/unknown.c
# test: gap_bins_hold
s/k \* (n - 1) \/ UNKNOWN_BINS;/k * k * (n - 1) \/ UNKNOWN_BINS \/ UNKNOWN_BINS;/
