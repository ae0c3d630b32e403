# A name that is right in forces may be wrong in turning.
# file: sim/gap/5_infer/score.c
# test: gap_score_sees_harm
s/^#define HARM 0\.05/#define HARM 100.0/
