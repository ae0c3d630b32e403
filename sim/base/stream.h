// stream.h - opens files that may be compressed by gzip.
#ifndef SIM_BASE_STREAM_H
#define SIM_BASE_STREAM_H

#include "base/error.h"
#include <stdio.h>

// Opens for reading. BAD_INPUT: no such file, or a folder; *stream is null then.
MUST_CHECK done_t stream_open(FILE **stream, const char *path, why_t *why);

// The first byte, which stays to be read; EOF if empty or unreadable.
int stream_peek(FILE *stream);

#endif
