# Of an inertia nobody asks whether control that answers a draught makes it.
# file: sim/effects/fx_inertia.c
# test: answers_a_draught
s/.answers = true/.answers = false/
