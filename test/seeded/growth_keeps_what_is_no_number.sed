# Of the growth's sums those that cannot be are kept.
# file: src/judge_ceiling.c
# test: guard_forgets_a_growth
s/  if (!possible) \*s = /  if (false) *s = /
