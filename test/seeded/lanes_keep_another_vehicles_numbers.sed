# A lane takes the numbers of a vehicle's effects once, and not those of the next that flies in it.
# file: sim/body/abreast.c
# test: abreast
s/take(to->rigid, was->rigid, &b->rigid, RIGID_NUMBERS, lane);/if (was->rigid[0] == 0.0) &/
