# In the legacy mode pitch has the other sign.
# file: src/firmware/units.c
# test: app_
s/(float)c->roll - PITCH/(float)c->roll + PITCH/
