// option.h - a program's options: what stands on its command line and is none of them.
#ifndef SIM_BASE_OPTION_H
#define SIM_BASE_OPTION_H

#include "base/error.h"
#include <getopt.h>

// What getopt_long answered with `?`: not an option, or one without its value, or with a value that it does
// not take. Says which, and what is allowed. Returns BAD_INPUT.
done_t option_refuse(const struct option *options, const char *typed, why_t *why);

#endif
