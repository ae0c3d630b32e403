# What a sample has of its own is counted among the errors that last, too.
# file: sim/gap/3_feedback/slow_errors.c
# test: gap_tells_the_errors
s/const double own = 2\.0 \* white\[k\] \* white\[k\];/const double own = 0.0 * white[k];/
