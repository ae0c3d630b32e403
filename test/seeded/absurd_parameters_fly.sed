# Parameters fly unchecked.
# file: src/firmware/settings.c
# test: app_
s/if (params_check(&GLUE\.candidate) != ST_OK) return false;//
