# A command holds until the next row, though most are missed.
# file: sim/gap/2_predict/grid_motors.c
# test: gap_follows_commands_along_lines
s/along = g->by_speeds || (!mean .. grid_is_slow(g));/along = g->by_speeds;/
