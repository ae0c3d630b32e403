# The gyro speaks degrees.
# file: src/firmware/units.c
# test: app_
s/v3_scale(RAD_PER_DEG, V3_OF(sensors->gyro))/V3_OF(sensors->gyro)/
