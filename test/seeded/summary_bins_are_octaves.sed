# A quantile is good to half an octave.
# file: sim/flight/summary.c
# test: summary_tells_quantiles
s/(2.0 \* share - 1.0) \* SUMMARY_FINE)/(2.0 * share - 1.0))/
