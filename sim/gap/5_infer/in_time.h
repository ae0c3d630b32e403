// in_time.h - what is short, and what swings.
//
// Both are judged by what the flight itself is like at other times, or at neighbouring frequencies: a
// disturbance that lasts, of which no model knows how strong it was, is in both.
#ifndef SIM_GAP_5_INFER_IN_TIME_H
#define SIM_GAP_5_INFER_IN_TIME_H

#include "gap/5_infer/windows.h"

// A pulse: a constant from one time to another, 0.08 to 0.64 s, by generalised least squares. Statistic: over
// what such constants scatter by (median) at all times of the flights. from, to: time of its flight.
void in_time_pulses(const look_t *l, cell_t cell[LOOKED]);

// A line in the spectrum of the white residual, 1 to 8 Hz. Statistic: its amplitude over the median
// amplitude of the frequencies beside it, means of the power over stretches of 16 s. from, to: frequency.
void in_time_lines(const look_t *l, cell_t cell[LOOKED]);

#endif
