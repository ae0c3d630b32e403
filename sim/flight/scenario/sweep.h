// sweep.h - studies of the learner on the vertical axis: learning from one flight in several ways.
#ifndef SIM_FLIGHT_SCENARIO_SWEEP_H
#define SIM_FLIGHT_SCENARIO_SWEEP_H

#include "flight/scenario.h"
#include "flight/training.h"

// Sets up the learning flight of the request. BAD_INPUT: as scenario_learning_setup, or a controller that
// knows no ceiling distance.
MUST_CHECK done_t sweep_setup(setup_t *setup, const request_t *request, why_t *why);

// Learns from n samples in all its ways, and adds the outcome to *result.
typedef done_t sweep_learn_fn(const setup_t *setup, const training_t *training, int n, result_t *result,
                              why_t *why);

// Flies once, and calls learn with the samples that can be learned from, up to far_m.
MUST_CHECK done_t sweep_fly(const setup_t *setup, double far_m, sweep_learn_fn *learn, result_t *result,
                            why_t *why);

// Adds w1..w7, each in a column of its own.
void sweep_add_weights(cJSON *row, const rbf_weights_t *w);

#endif
