# Weights that are far out give a ratio below 1, and the thrust steps.
# file: src/curve.c
# test: faults_of_the_list
s/if (p->clip) {/if (false) {/
