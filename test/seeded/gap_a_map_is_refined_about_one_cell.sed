# The shapes of a map's voltage are refined between those of one cell.
# file: sim/gap/5_infer/shape.c
# test: gap_finds_the_sag_of_a_battery
s/const shape = p->own->shape;/const shape = fx->shape;/
