# What motors still do of commands that a log misses is a pulse.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_no_pulse_where_commands
s/log(20.0) \* slower/0.0 * slower/
