# A range of a block file is no older than its row.
# file: sim/gap/1_read/read.c
# test: blocks_give_a_range
s/return age_s + own.late_s + /return age_s + /
