// short_vector.h - SUNDIALS's serial vector, with the operations that a Runge-Kutta step needs written for a
// few numbers: the library's own are written for millions, and cost more than the right-hand side.
#ifndef SIM_PLANT_SHORT_VECTOR_H
#define SIM_PLANT_SHORT_VECTOR_H

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

#define SHORT_VECTOR_MAX 136

// n numbers, all 0. Null: n > SHORT_VECTOR_MAX, or no memory. N_VDestroy frees it; its clones have the same
// operations.
N_Vector short_vector_new(int n, SUNContext context);

#endif
