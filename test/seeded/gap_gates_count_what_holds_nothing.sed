# A nominal flight that would not show a size counts in the gate as any other.
# file: sim/gap/5_infer/score.c
# test: gap_score_asks_flights
s/2 \* n < flights ? NULL : shows/n < 0 ? shows : NULL/
