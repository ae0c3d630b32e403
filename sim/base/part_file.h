// part_file.h - files that have no name until they are complete, so that nothing of them outlives the
// process.
//
// Whatever ends it, SIGKILL and a crash included: the file system takes a file without a name back. A name is
// given at the end, between part_hold and part_release, where signals that end the process wait; what SIGKILL
// or a power cut leaves there is a complete file beside its place.
#ifndef SIM_BASE_PART_FILE_H
#define SIM_BASE_PART_FILE_H

#include <stdbool.h>

typedef struct {
  int file;      // descriptor
  bool linkable; // can be given a name; else (some network and layered file systems) it is copied at the end
} part_t;

// A file in that folder, without a name. False: errno says why.
bool part_open(part_t *p, const char *folder);

// The same where the file system knows no files without a name: one whose name is taken away at once.
bool part_open_unlinked(part_t *p, const char *folder);

// A second descriptor of it, to write to and to close. -1: errno says why.
int part_writer(const part_t *p);

// Gives what was written a name; its last six letters are XXXXXX and are replaced, as mkstemp does. False:
// errno says why, and there is no such file.
bool part_name(const part_t *p, char *name);

// After this, what has no name is gone.
void part_close(part_t *p);

// From part_hold to part_release signals wait: what is done in between is done as a whole. A signal that is
// ignored (nohup) or that somebody else listens to is left as it is.
void part_hold(void);
void part_release(void);

#endif
