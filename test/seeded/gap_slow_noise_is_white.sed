# The score's ups and downs over blocks are not looked at.
# file: sim/gap/5_infer/information.c
# test: gap_information_widens
s/squares\[k\] += score \* score/squares[k] += 0.0 * score/
