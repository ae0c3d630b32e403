# The covariance is that of free air, below a ceiling too.
# file: src/height.c
# test: height_takes
s/kdt = HEIGHT_S \* k_per_s2/kdt = 0.0f * k_per_s2/
