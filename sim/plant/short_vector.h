// short_vector.h - SUNDIALS's serial vector, with the operations of a Runge-Kutta step written for a few
// numbers: the library's own are made for millions, and cost more than the right-hand side.
#ifndef SIM_PLANT_SHORT_VECTOR_H
#define SIM_PLANT_SHORT_VECTOR_H

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

#define SHORT_VECTOR_MAX 136

// A vector of n numbers, all 0. Null if n > SHORT_VECTOR_MAX or there is no memory. Free it by N_VDestroy.
// Its clones have the same operations.
N_Vector short_vector_new(int n, SUNContext context);

#endif
