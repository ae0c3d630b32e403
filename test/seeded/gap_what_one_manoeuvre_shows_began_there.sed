# A name that one manoeuvre shows is not known, though the rest of the flight says the same.
# file: sim/gap/5_infer/local.c
# test: one_manoeuvre_shows
s/if (rest < chance/if (rest < 1e9 * chance/
