# What flights differ by is a colour of the noise.
# file: sim/gap/5_infer/whiten.c
# test: users_logs_of_flights
s/  rows_center(r, own);/  if (!r) rows_center(r, own);/
