# A scale that one way alone bears out is named.
# file: sim/gap/diagnose.c
# test: missed_commands_made
s/if (stands) continue;/continue;/
