// in_time.h - pulses and spectral lines in a residual.
//
// Both are compared with the same flight at other times, or at neighbouring frequencies: a lasting
// disturbance, whose strength no model knows, is there, too.
#ifndef SIM_GAP_5_INFER_IN_TIME_H
#define SIM_GAP_5_INFER_IN_TIME_H

#include "gap/5_infer/windows.h"

// The largest pulse of each channel: a constant over 0.08 to 0.64 s, by generalised least squares. Statistic:
// its size over the scatter (median) of such constants at all times. from, to: time of its flight, s.
void in_time_pulses(const look_t *l, cell_t cell[LOOKED]);

// The largest line of each channel in the spectrum of the white residual, 1 to 8 Hz. The power is a mean over
// stretches of 16 s. Statistic: the amplitude over the median amplitude of the frequencies beside it. from,
// to: frequency, Hz.
void in_time_lines(const look_t *l, cell_t cell[LOOKED]);

#endif
