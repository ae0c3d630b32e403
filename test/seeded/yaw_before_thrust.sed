# Yaw is given up first.
# file: src/mixer.c
# test: mixer
s/const float yaw_share = yaw_share_of(base, yaw_N, max)/const float yaw_share = yaw_share_of(base, yaw_N, max) > 2.0f ? 0.0f : 1.0f/
