# The accelerometer speaks g.
# file: src/firmware/units.c
# test: app_
s/v3_scale(GRAVITY_MPS2, V3_OF(sensors->acc))/V3_OF(sensors->acc)/
