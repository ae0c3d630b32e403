# The range sample is taken for one that is a step older than it is.
# file: src/height.c
# test: height_follows
s/s->x\[HEIGHT_H\] - HEIGHT_DOWN_AGE_S \* (/s->x[HEIGHT_H] - (HEIGHT_DOWN_AGE_S + HEIGHT_S) * (/
