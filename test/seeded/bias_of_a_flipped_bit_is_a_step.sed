# What the look for a bias remembers is far out, and the vehicle flies by a bias of 3 m/s2 that is none.
# file: src/judge_motion.c
# test: guard_finds_a_step_of_the_bias
s/FOR_WHOM(fabsf(rest) <= REST_MAX_MPS2, g)/FOR_WHOM(true, g)/
