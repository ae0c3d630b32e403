# A read-only parameter is written.
# file: sim/link/link_params.c
# test: test_link
s/if (type \& PARAM_RONLY || r->size/if (r->size/
