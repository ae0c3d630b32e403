# Likewise in the signals of the outer loop.
# file: src/outer.c
# test: flight_flies_on
s/!sync_good(&f->sync)/false/
