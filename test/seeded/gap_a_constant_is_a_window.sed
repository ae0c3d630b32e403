# A constant over the whole flight lies at one place.
# file: sim/gap/5_infer/unknown.c
# test: gap_takes_a_constant
s/centred ? cross \/ all : 0\.0;/centred \&\& cross < 0.0 ? cross \/ all : 0.0;/
