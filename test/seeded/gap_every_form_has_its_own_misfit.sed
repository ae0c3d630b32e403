# Of an effect that is tried in many forms each has the misfit of the whole.
# file: sim/gap/5_infer/information.c
# test: gap_information_knows
s|CANDIDATES_MISFIT \* CANDIDATES_MISFIT / candidates_of(c, i)|CANDIDATES_MISFIT * CANDIDATES_MISFIT|
