# Likewise in the signals of the outer loop.
# file: src/outer.c
# test: flight_flies_on
s/if (!f->started || sync_good(&f->sync)) return;/return;/
