# Flight code with a fused multiply-add.
# file: include/flight/lpf2.h
# test: objects
s/const float y = c->b0 \* x + /const float y = __builtin_fmaf(c->b0, x, 0.0f) + /
