# The range sample is taken for one that is half a step younger than it is.
# file: src/height.c
# test: height_follows
s/s->x\[HEIGHT_H\] - HEIGHT_DOWN_AGE_S \* (/s->x[HEIGHT_H] - (HEIGHT_DOWN_AGE_S - 0.5f * HEIGHT_S) * (/
