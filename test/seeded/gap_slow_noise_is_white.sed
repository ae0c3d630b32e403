# The score's ups and downs over blocks are not looked at.
# file: sim/gap/5_infer/information.c
# test: gap_information_widens
s/of_blocks += one \* one;/of_blocks += 0.0 * one * one;/
