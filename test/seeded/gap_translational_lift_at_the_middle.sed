# Translational lift is that of the middle, wherever the hubs go.
# file: sim/effects/fx_translational_lift.c
# test: translational_lift_at_the_hubs
s/fx_hub(motion, i, use->p\[1\])/fx_hub(motion, i, 0.0 * use->p[1])/
