// part_file.h - files that are being written beside their places, and that do not outlive an interruption.
//
// SIGINT, SIGTERM and SIGHUP remove them all and then end the process as if nobody had listened. A signal
// that is ignored (nohup) or that somebody else listens to is left as it is.
#ifndef SIM_IO_PART_FILE_H
#define SIM_IO_PART_FILE_H

#include <stdbool.h>

#define PART_FILES_MAX 16

// Makes a file of that name, whose last six letters are XXXXXX and are replaced, as mkstemp does. Returns its
// descriptor; -1: errno says why (EMFILE: there are PART_FILES_MAX).
int part_file_open(char *name);

// Removes it.
void part_file_remove(const char *name);

// Moves it to its place. False: errno says why, and it is still there.
bool part_file_move(const char *name, const char *place);

// From part_hold to part_release a signal waits: what is done in between is done as a whole.
void part_hold(void);
void part_release(void);

#endif
