# The estimator's height comes back at once.
# file: src/height.c
# test: height
s/^#define FADE .*/#define FADE 1.0f/
