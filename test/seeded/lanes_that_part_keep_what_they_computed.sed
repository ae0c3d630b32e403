# Flights whose lanes went the other way at a branch keep what was computed for those that are more.
# file: sim/base/lane_whole.hpp
# test: together
s/lanes_in = most ? say : lanes_in & ~say;/(void)0;/
