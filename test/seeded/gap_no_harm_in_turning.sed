# A name that is right in forces may be wrong in turning.
# file: sim/gap/5_infer/score.c
# test: gap_score_sees_harm
s/(1\.0 + SELECT_GAIN) + 10/100.0 + 10/
