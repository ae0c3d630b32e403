# Two effects that do the same are not alike.
# file: sim/gap/5_infer/local.c
# test: gap_knows_which
s/^#define ALIKE 0\.25/#define ALIKE 2.5/
