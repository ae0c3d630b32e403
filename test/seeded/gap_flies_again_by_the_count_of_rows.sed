# Behind a gap in time, what is flown again takes the commands of as many rows later.
# file: sim/gap/7_verify/resimulate.c
# test: gap_flies_again_behind_a_gap
s/if (t_s\[middle\] < from_s)/if (t_s[0] + middle * log_s < from_s)/
