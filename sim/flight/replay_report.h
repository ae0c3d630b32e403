// replay_report.h - the result of a replay (logs/replay.h), in words.
#ifndef SIM_FLIGHT_REPLAY_REPORT_H
#define SIM_FLIGHT_REPLAY_REPORT_H

#include "flight/setup.h"

// Replays the log at path with the parameters that the request sets, and prints the result to standard
// output. Errors as param_check_all and replay_fly.
MUST_CHECK done_t replay_report(const char *path, const request_t *request, why_t *why);

#endif
