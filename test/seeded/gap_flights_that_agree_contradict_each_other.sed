# An effect that is the same in every flight counts as what they contradict each other about.
# file: sim/gap/5_infer/information.c
# test: gap_errors_grow
s/score\[f\] - holds\[f\] \/ held \* all/score[f] - 0.0 * holds[f] \/ held * all/
