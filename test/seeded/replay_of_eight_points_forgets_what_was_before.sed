# Eight points at a time gusts are those of the first instant of each.
# file: sim/body/lanes.cpp
# test: gap_replay
s/for (int m = 0; m < FX_MEMORY; m++) other |= .*/for (int m = 0; m < FX_MEMORY; m++) other |= 0;/
s/^  lanes_in = 0;$/  lanes_in += 0;/
