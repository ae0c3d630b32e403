# What fits better in a name's place, and explains something else, is told as its rival.
# file: sim/gap/5_infer/family.c
# test: only_where_it_does_the_names_work
s/return other < named \&\& other - /return other < named || other - /
