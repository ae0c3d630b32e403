# A load that drops in a climb is taken for a ceiling.
# file: src/judge_ceiling.c
# test: guard_takes_no_jolt
s/#define GROWTH_SHARE  0.8f/#define GROWTH_SHARE 0.7f/
