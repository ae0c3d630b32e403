// programs.h - runs the programs as a user does.
#ifndef TEST_RIG_PROGRAMS_H
#define TEST_RIG_PROGRAMS_H

#include <stddef.h>

typedef enum { STREAM_OUTPUT, STREAM_ERROR } stream_t;

// Runs a shell line in which this build's programs are found by name and $S is the scratch folder. Returns
// the exit status; text gets what was written to the stream, without the scratch folder's path.
int program_run(const char *line, stream_t stream, char *text, size_t size);

// Lists the scratch folder, to compare before and after.
void program_listing(char *text, size_t size);

// Starts a shell line with a disk that is full after 512 bytes or 1 KB, depending on the shell. Coverage
// counts go elsewhere: a truncated file would spoil the counts of others.
#define PROGRAM_DISK_FULL "export GCOV_PREFIX=$S/.counts GCOV_ERROR_FILE=/dev/null; ulimit -f 1; "

#endif
