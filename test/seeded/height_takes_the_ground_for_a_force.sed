# The own height filter knows nothing of the ground.
# file: src/height.c
# test: height_
s/return 1\.0f + in->ground_excess;/return 1.0f;/
