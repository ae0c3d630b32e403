# The guard waits for a sample of the thrust that never comes.
# file: src/watch.c
# test: watch_
s/g->force_new = (f->due & FLIGHT_LEARN) != 0;/g->force_new = false;/
