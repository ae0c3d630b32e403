# No set is taken where every call is late.
# file: src/firmware/settings.c
# test: app_
s/if (GLUE\.flight\.waiting != 0 \&\& (GLUE/if (GLUE.flight.waiting > 99 \&\& (GLUE/
