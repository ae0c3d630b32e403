# A sample that is no number teaches.
# file: src/rls.c
# test: rls
s/if (!f_finite(y) || !f_finite(dot(a, a))) return ST_BAD_INPUT;//
