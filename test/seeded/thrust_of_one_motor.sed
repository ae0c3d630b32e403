# Thrust units are of all four motors.
# file: src/firmware/units.c
# test: app_
s/MOTORS \* THRUST_MAX \/ UNITS_MAX/THRUST_MAX \/ UNITS_MAX/
