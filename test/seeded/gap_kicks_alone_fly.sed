# Commands that kick are averaged over the kicks alone.
# file: sim/gap/1_read/check.c
# test: gap_reads_commands_that_kick
s/#define BLOCK_S     0.2/#define BLOCK_S     0.0/
