// bench_gap.h - how the time of a diagnosis grows with the log and with the candidates.
#ifndef TOOLS_BENCH_GAP_H
#define TOOLS_BENCH_GAP_H

#include "base/error.h"

// Prints one line for each. BAD_INPUT, FAILED: the flight could not be made or read.
MUST_CHECK done_t bench_gap(why_t *why);

#endif
