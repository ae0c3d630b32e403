# A lane takes the numbers of a vehicle's rotors and inertia once, and not those that an effect changed since.
# file: sim/body/abreast.c
# test: abreast
s/if (a->has\[lane\].body == b && a->has\[lane\].changed == b->changed) return;/if (a->has[lane].body == b) return;/
