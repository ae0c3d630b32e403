# A held-out flight is held to what the fitted ones have in common, whatever these differ by.
# file: sim/gap/7_verify/verify.c
# test: users_logs_of_flights
s/rows_beyond(set_rows(s, ch), l->r\[ch\], turns->own\[ch\]);/rows_beyond(set_rows(s, ch), l->r[ch], 0.0 * turns->own[ch]);/
