# What acts in one half of the flights only is named.
# file: sim/gap/5_infer/local.c
# test: gap_knows_a_name_that_acts
s/all_fy \* all_fy \/ all_ff > chance/all_fy * all_fy \/ all_ff > 1e9 * chance/
