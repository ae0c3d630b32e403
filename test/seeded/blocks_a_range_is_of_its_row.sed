# A range of a file of its own is as new as the row in which it stands.
# file: sim/logs/blocks.c
# test: blocks_tell_how_long
s/block->late_ms += now_ms - block->before.t_ms/block->late_ms += now_ms - now_ms/
