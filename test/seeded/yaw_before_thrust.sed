# Yaw is not given up first.
# file: src/mixer.c
# test: mixer
s/const float turn = f_clamp(yaw_N, -right, left);/const float turn = yaw_N;/
