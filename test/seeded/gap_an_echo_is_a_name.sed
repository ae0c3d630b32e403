# Something at one place is told by the name of an effect.
# file: sim/gap/5_infer/local.c
# test: gap_knows_a_name_that_is
s/\*echo = first > ECHO \* gain + 20\.0 ||/*echo = first < -gain \&\&/
