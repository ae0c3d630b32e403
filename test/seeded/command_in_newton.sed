# Normalised forces are shares of THRUST_MAX.
# file: src/firmware/units.c
# test: app_
s/f_clamp(force_N\[i\] \/ THRUST_MAX, 0\.0f, 1\.0f)/f_clamp(force_N[i], 0.0f, 1.0f)/
