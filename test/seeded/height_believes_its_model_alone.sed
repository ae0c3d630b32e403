# Nobody asks whether the accelerometer fits the model.
# file: src/height.c
# test: height
s/s->acc_odd < HEIGHT_ODD \&\& //
