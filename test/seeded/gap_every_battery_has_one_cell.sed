# The voltage of a thrust map is looked for about that of one cell, whatever the battery.
# file: sim/effects/fx_battery_sag.c
# test: gap_finds_the_sag_of_a_battery
s/.shape_by_cell = true/.shape_by_cell = false/
