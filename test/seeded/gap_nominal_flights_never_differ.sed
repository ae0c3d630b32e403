# Nominal flights are weighed as if none of the log's differed.
# file: sim/gap/5_infer/whiten.c
# test: gap_weighs_nominal_flights
s/if (e->between) g->color/if (!e) g->color/
