// stream.h - a file to read from, packed by gzip or not.
#ifndef SIM_BASE_STREAM_H
#define SIM_BASE_STREAM_H

#include "base/error.h"
#include <stdio.h>

// BAD_INPUT: no such file, a folder; *stream is null then.
MUST_CHECK done_t stream_open(FILE **stream, const char *path, why_t *why);

// The first byte, which stays to be read; EOF: empty, or it cannot be read.
int stream_peek(FILE *stream);

#endif
