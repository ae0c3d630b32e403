// whole_file.h - what a program writes: every file complete, or none of them there.
//
// All are opened first, filled, and put in their places together at the end. What is a file, or not there
// yet, has no name until then (base/part_file.h) and is moved to its place. A symbolic link to a file is
// refused: it is neither followed nor replaced. What is no file (a device, a pipe, the standard output), also
// through a link, gets its text at the end, in one go.
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
  FILE *direct;                // the device or pipe that gets the text at the end; null: it is a file
  char target[WHOLE_PATH_MAX]; // its place, without links
  part_t part;                 // where it is until the end, if direct is null
  char beside[WHOLE_PATH_MAX]; // its name between the end and its place; empty: none
} whole_file_t;

// All zero: none.
typedef struct {
  whole_file_t of[WHOLE_FILES_MAX];
  int n;
} whole_files_t;

// One more file to write, *file; path null: none, *file null. BAD_INPUT: a folder, a symbolic link to a
// file or to nowhere, a place that another one of the files has already, or that cannot be written.
MUST_CHECK done_t whole_files_open(whole_files_t *w, const char *path, FILE **file, why_t *why);

// BAD_INPUT: this file, which is read (null: none is), would be written too.
MUST_CHECK done_t whole_files_spare(const whole_files_t *w, const char *path, why_t *why);

// Puts all in their places, if all could be written and the standard output too: what cannot be told is not
// done. FAILED: not so (disk full); what was there before is kept, and nothing lies beside.
MUST_CHECK done_t whole_files_commit(whole_files_t *w, why_t *why);

// Gives all up: what was there before is kept, and nothing lies beside.
void whole_files_drop(whole_files_t *w);

// The end of a program: commits if all went well so far, else drops; says what was wrong. The exit status.
int whole_files_exit(whole_files_t *w, const char *program, done_t status, why_t *why);

#endif
