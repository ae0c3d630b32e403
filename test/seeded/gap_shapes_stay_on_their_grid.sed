# A sag is sought about the tried voltages alone: what lies between them leaves a misfit.
# file: sim/gap/5_infer/bend.c
# test: gap_finds_a_shape_between
s/here \* exp(best) : here/here : here/
