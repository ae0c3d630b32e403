# A share of the own height that a flipped bit has made endless is never mended.
# file: src/height.c
# test: flight_flies_on_with_any_bit
s/s->share = f_clamp(share, 0.0f, 1.0f);/s->share = share;/
