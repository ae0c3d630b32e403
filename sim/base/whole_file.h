// whole_file.h - a program's output files: all of them complete, or none.
//
// All files are opened first, filled, and moved to their places together at the end. Until then, a regular
// file has no name (base/part_file.h). A symbolic link to a file is refused: it is neither followed nor
// replaced. What is not a regular file (a device, a pipe, the standard output), also behind a link, gets its
// text at the end, in one go.
#ifndef SIM_BASE_WHOLE_FILE_H
#define SIM_BASE_WHOLE_FILE_H

#include "base/error.h"
#include "base/part_file.h"
#include <stdbool.h>
#include <stdio.h>

#define WHOLE_FILES_MAX 6
#define WHOLE_PATH_MAX  4096

typedef struct {
  FILE *file;                  // to write to
  FILE *direct;                // the device or pipe that gets the text at the end; null for a file
  char target[WHOLE_PATH_MAX]; // its destination, without links
  part_t part;                 // the file until the end, if direct is null
  char beside[WHOLE_PATH_MAX]; // its temporary name just before the move; empty: none
} whole_file_t;

// All zero: no files.
typedef struct {
  whole_file_t of[WHOLE_FILES_MAX];
  int n;
} whole_files_t;

// Opens one more file to write, *file; if path is null, *file is null. BAD_INPUT: a folder, a symbolic link
// to a file or to nowhere, the destination of another output file, or a path that cannot be written.
MUST_CHECK done_t whole_files_open(whole_files_t *w, const char *path, FILE **file, why_t *why);

// BAD_INPUT: `path`, which is read (null if none is), would be written, too.
MUST_CHECK done_t whole_files_spare(const whole_files_t *w, const char *path, why_t *why);

// Moves all files to their places if all of them, and the standard output, could be written: without its
// report the program has not succeeded. FAILED: not so (disk full); existing files are kept, and no temporary
// file remains.
MUST_CHECK done_t whole_files_commit(whole_files_t *w, why_t *why);

// Discards all files: existing ones are kept, and no temporary file remains.
void whole_files_drop(whole_files_t *w);

// Ends a program: commits if `status` is DONE, else discards; prints the error. Returns the exit status.
int whole_files_exit(whole_files_t *w, const char *program, done_t status, why_t *why);

#endif
