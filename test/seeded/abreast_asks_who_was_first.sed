# Who left the others is still asked how long a step is.
# file: sim/body/abreast.c
# test: side_by_side_nobody_asks
s/if (again) first = b\[__builtin_ctz(a->moved)\];/if (again) first = a->first;/
