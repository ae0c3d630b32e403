# Slow rows that are motion have a lead.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_reads_a_pilots_lead
s/^#define ALTERNATES .*/#define ALTERNATES (-0.5)/
