# velocity_body is not looked at.
# file: src/firmware/units.c
# test: app_
s/to->vel_in_body = sp->velocity_body;/to->vel_in_body = false;/
