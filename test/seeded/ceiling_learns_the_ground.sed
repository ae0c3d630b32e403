# What the ground gives is learned as the ceiling's.
# file: src/outer.c
# test: channel_
s/&f->sample, f->ground\.lesson_excess)/\&f->sample, 0.0f)/
