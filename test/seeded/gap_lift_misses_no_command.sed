# A jump of the lift's command between two rows of a log that misses commands is a pulse of force_z.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_no_pulse_where_commands
s/return channel == CH_FZ || /return /
