# What one flight has all the time is a pulse, and one more.
# file: sim/gap/5_infer/in_time.c
# test: gap_finds_no_pulse_in_what
s/if (l->s->n_grid > 1) rows_clear/if (l->s->n_grid > 100) rows_clear/
