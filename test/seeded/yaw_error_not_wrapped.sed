# Stock INDI, fault 2: the yaw error is not wrapped.
# file: include/flight/att_indi.h
# test: inner_loop
s/e\.w < 0\.0f ? -2\.0f : 2\.0f/2.0f/
