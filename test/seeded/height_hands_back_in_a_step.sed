# The estimator's height comes back at once.
# file: src/height.c
# test: height
s/^#define FADE_S .*/#define FADE_S HEIGHT_S/
