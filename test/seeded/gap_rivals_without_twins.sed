# What stands for a thrust scale in a slow log is no rival to a mass.
# file: sim/gap/5_infer/family.c
# test: gap_tells_mass_beside
s/twins < 2/twins < 1/
