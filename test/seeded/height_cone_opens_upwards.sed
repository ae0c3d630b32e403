# The cone of the range sensor makes a slanted range longer, not shorter.
# file: src/height.c
# test: height_follows
s/up \* CONE_COS + sqrtf/up * CONE_COS - sqrtf/
