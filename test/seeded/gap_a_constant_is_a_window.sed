# A constant over the whole flight lies at one place.
# file: sim/gap/5_infer/windows_cut.h
# test: gap_takes_a_constant
s/centred ? w->cross \/ all->own : 0\.0;/centred \&\& w->cross < 0.0 ? w->cross \/ all->own : 0.0;/
