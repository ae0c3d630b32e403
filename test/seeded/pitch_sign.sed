# A pitch set point is positive nose up.
# file: src/firmware/units.c
# test: app_
s/-RAD_PER_DEG \* sp->attitude\.pitch/RAD_PER_DEG * sp->attitude.pitch/
