# What the ceiling gives is learned as the ground's.
# file: src/ground.c
# test: ground_
s/= in->excess;/= 0.0f;/
