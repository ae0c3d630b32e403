# A name is held to act in one part alone because flights differ.
# file: sim/gap/5_infer/local.c
# test: users_logs_of_flights
s/rows_level(r, part\[k\]);/if (!r) rows_level(r, part[k]);/
