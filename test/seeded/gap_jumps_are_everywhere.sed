# Of a residual's jumps all increments count.
# file: sim/gap/2_predict/residual.c
# test: gap_jumps_are_few
s/const int first = n - (n + 99) \/ 100;/const int first = n - n \/ 2;/
