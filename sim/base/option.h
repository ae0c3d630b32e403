// option.h - error messages for command-line options that a program does not accept.
#ifndef SIM_BASE_OPTION_H
#define SIM_BASE_OPTION_H

#include "base/error.h"
#include <getopt.h>

// Call it where getopt_long returned `?`: `typed` is not an option, lacks its value, or has one that it does
// not take. Says which, and what is allowed. Returns BAD_INPUT.
done_t option_refuse(const struct option *options, const char *typed, why_t *why);

#endif
