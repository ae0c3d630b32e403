# Stock INDI, fault 2: the yaw error is not wrapped.
# file: src/att_indi.c
# test: inner_loop
s/e\.w < 0\.0f ? -2\.0f : 2\.0f/2.0f/
