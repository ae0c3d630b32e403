# Nominal pilots have no lead on the rates, and their commands less noise than the log's.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_reads_a_pilots_lead
s/^    w->rate_lead\[axis\] = .*/    w->rate_lead[axis] = 0.0 * d;/
