# The size of what lies in a strip is that of white rows.
# file: sim/gap/5_infer/unknown.c
# test: gap_measures_what_lies_in_a_strip
s/^  cell->size = size;/  (void)size;/
