# What is done to the state of some of eight vehicles is done to all of them.
# file: sim/base/lane_number.hpp
# test: faults_come_to_the_same
s/lanes_undo(~say, state, &was, sizeof was);/(void)0;/
