# The height filter is flown by whatever its sensors say.
# file: src/height.c
# test: height
s/good = state \&\& fits(s, in) \&\& p->own != 0/good = state \&\& (fits(s, in) || s->fit >= HEIGHT_FIT) \&\& p->own != 0/
