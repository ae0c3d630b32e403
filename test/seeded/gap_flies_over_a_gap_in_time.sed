# After a gap the nominal flight flies to where the log goes on.
# file: sim/gap/3_feedback/nominal_fly.c
# test: gap_nominal_flight_goes_on
s/^    if (goes_on(f)) {/    if (goes_on(f) \&\& f->puts > 1000) {/
