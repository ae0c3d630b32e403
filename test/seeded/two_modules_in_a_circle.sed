# Modules that need each other are one module, or one of them holds two things.
# file: sim/base/number.h
# test: arrows
/^#define SIM_BASE_NUMBER_H/a #include "base/option.h"
