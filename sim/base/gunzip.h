// gunzip.h - a stream that decompresses a gzip file.
#ifndef SIM_BASE_GUNZIP_H
#define SIM_BASE_GUNZIP_H

#include <stdio.h>

#define GUNZIP_MAGIC 0x1F // first byte of a gzip file

// Returns a stream that reads `packed` from its current position (also files joined by `cat`); closing it
// closes `packed`. A truncated file ends where it is cut; reads from a damaged one fail. Null if there is no
// memory; `packed` is closed then, too.
FILE *gunzip_open(FILE *packed);

#endif
