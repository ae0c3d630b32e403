# White rows hold as much of a constant as if no flight had one of its own.
# file: sim/gap/2_predict/color.c
# test: gap_holds_a_constant
s/(1\.0 - kept(c, k\.holds)) \* k\.mean/0.0 * (1.0 - kept(c, k.holds)) * k.mean/
