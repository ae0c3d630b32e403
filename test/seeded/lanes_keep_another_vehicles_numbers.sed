# A lane takes the numbers of a vehicle's rotors and inertia once, and not those that an effect changed since.
# file: sim/body/abreast.c
# test: abreast
s/take(to->rigid, was->rigid, &b->rigid, RIGID_NUMBERS, lane);/if (was->rigid[0] == 0.0) &/
