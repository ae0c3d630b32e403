# Of an effect that is tried in many forms each has the misfit of the whole.
# file: sim/gap/5_infer/information.c
# test: gap_information_knows
s|misfit \* misfit / candidates_of(c, i)|misfit * misfit|
