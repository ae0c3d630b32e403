# A candidate that moves the centre of mass is replayed with the rotors where they were without it.
# file: sim/gap/2_predict/predict.c
# test: gap_replay
s/if (was && same_rotors(\(.*\))) {/if (was \&\& (same_rotors(\1) || was->rigid >= 0)) {/
