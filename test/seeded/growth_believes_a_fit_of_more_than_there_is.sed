# A flipped sum of the growth that explains more of the ratio than there is stands for a ceiling.
# file: src/judge_ceiling.c
# test: guard_takes_no_flipped_sum
s/fy \* fy <= ff \* yy + GROWTH_ROUND/fy * fy <= 1e9f * (ff * yy + GROWTH_ROUND)/
