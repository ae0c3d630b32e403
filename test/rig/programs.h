// programs.h - the programs as a person runs them.
#ifndef TEST_RIG_PROGRAMS_H
#define TEST_RIG_PROGRAMS_H

#include <stddef.h>

typedef enum { STREAM_OUTPUT, STREAM_ERROR } stream_t;

// Runs a line of the shell, in which this build's programs are found by name and $S is the scratch folder.
// Returns the exit status; text gets what was written to the stream, without the scratch folder's path.
int program_run(const char *line, stream_t stream, char *text, size_t size);

// The names in the scratch folder, for a look before and after.
void program_listing(char *text, size_t size);

// Of a shell line: a disk that is full after 512 bytes or 1 KB, as the shell counts. What coverage counts is
// written apart: cut off, it would spoil what others counted.
#define PROGRAM_DISK_FULL "export GCOV_PREFIX=$S/.counts GCOV_ERROR_FILE=/dev/null; ulimit -f 1; "

#endif
