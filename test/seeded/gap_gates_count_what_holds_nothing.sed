# A nominal flight that would not show a size counts in the gate as any other.
# file: sim/gap/5_infer/score.c
# test: gap_score_asks_flights
s/if (2 \* would < flights || size \* size/if (would < 99 || size * size/
