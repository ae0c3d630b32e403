# A heading in degrees.
# file: src/firmware/units.c
# test: app_
s/RAD_PER_DEG \* sp->attitude\.yaw/sp->attitude.yaw/
