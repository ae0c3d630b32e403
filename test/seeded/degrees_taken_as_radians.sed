# Stock INDI, fault 4: with the outer loop off degrees are used as radians.
# file: src/firmware/units.c
# test: app_
s/by_angle ? RAD_PER_DEG \* sp->attitude\.roll/by_angle ? sp->attitude.roll/
