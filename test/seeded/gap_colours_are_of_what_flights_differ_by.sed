# What flights differ by is a colour of the noise.
# file: sim/gap/2_predict/color.c
# test: users_logs_of_flights
s/^  rows_center(r, room);/  if (!r) rows_center(r, room);/
