# No wind is looked for that the rotors feel.
# file: sim/effects/fx_wind.c
# test: gap_names_air_that_moves
s/\.kind = {0\.0, 1\.0}/.kind = {0.0, 0.0}/
