# What a name takes from the other channels does not count: a large ceiling is not named for what the tilt errs.
# file: sim/gap/5_infer/score.c
# test: gap_score_takes_more_than_a_twentieth_for_harm
s/HARM \* (before\[i\] + taken)/HARM * before[i]/
