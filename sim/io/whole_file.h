// whole_file.h - a file that is complete or not there: written beside its place and moved when done.
#ifndef SIM_IO_WHOLE_FILE_H
#define SIM_IO_WHOLE_FILE_H

#include "error.h"
#include <stdio.h>

typedef struct {
  FILE *file; // to write to
  char path[400], beside[440];
} whole_file_t;

// ST_BAD_INPUT: cannot be written there.
MUST_CHECK status_t whole_file_open(whole_file_t *f, const char *path, why_t *why);

// ST_BAD_INPUT: something could not be written (disk full); the old file, if there was one, is kept.
MUST_CHECK status_t whole_file_close(whole_file_t *f, why_t *why);

// Gives the file up: what was written is removed, the old file, if there was one, is kept.
void whole_file_drop(whole_file_t *f);

#endif
