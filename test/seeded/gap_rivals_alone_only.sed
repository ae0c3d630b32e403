# A rival is asked for as if no other name could give a part of it back.
# file: sim/gap/5_infer/family.c
# test: gap_takes_for_a_rival_what_is_alike_beside
s/= fmax(like, score_likeness/= fmax(-1.0, score_likeness/
