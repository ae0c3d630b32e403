// replay_report.h - what came of a replay (logs/replay.h), in words.
#ifndef SIM_FLIGHT_REPLAY_REPORT_H
#define SIM_FLIGHT_REPLAY_REPORT_H

#include "flight/setup.h"

// Flies the log again with the parameters that the request sets, and says on the standard output what came of
// it. Errors as replay_fly.
MUST_CHECK done_t replay_report(const char *path, const request_t *request, why_t *why);

#endif
