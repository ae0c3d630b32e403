# Jumps of the commands count as noise.
# file: sim/gap/3_feedback/closed_loop.c
# test: gap_reads_a_pilots_lead
s/^#define JUMPS .*/#define JUMPS HUGE_VAL/
