# What flights have for their own is not found.
# file: sim/gap/2_predict/color.c
# test: gap_finds_by_how_much
s/return sqrt(fmax(d\.q - (d\.flights - 1), 0\.0)/return 0.0 * sqrt(fmax(d.q - (d.flights - 1), 0.0)/
