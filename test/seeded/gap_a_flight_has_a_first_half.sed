# A flight's halves are its first and its second.
# file: sim/gap/2_predict/set.c
# test: gap_halves_of_a_flight
s/(int)(since_s \/ stretch_s) % 2/(since_s > 0.5 * fmax(span_s, stretch_s))/
