# What a flight has for its own is the same however much it is lifted.
# file: sim/gap/2_predict/set.h
# test: gap_takes_out_of_rows
s/return r->lift ? r->lift\[row\] : 1\.0;/return r->lift \&\& row < 0 ? r->lift[row] : 1.0;/
