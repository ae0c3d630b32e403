# Yaw is given up first.
# file: src/mixer.c
# test: mixer
s/const float yaw_share = share_that_fits(force_N, yaw_N, max);/const float yaw_share = share_that_fits(force_N, yaw_N, max) > 2.0f ? 0.0f : 1.0f;/
