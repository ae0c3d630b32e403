# What is found must not change what is predicted.
# file: sim/gap/2_predict/residual.h
# test: arrows
/^#include "gap\/2_predict\/predict.h"/a #include "gap/5_infer/found.h"
