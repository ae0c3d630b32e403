# What looks find by a few white rows is told, though the rows inside are like those outside.
# file: sim/gap/5_infer/unknown.h
# test: gap_tells_nothing_of_a_size_within_two_errors
s/fabs(cell->size) > SCORE_ERRORS \* cell_error(cell)/cell->statistic >= 0.0/
