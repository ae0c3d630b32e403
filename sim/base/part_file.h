// part_file.h - files without a name until they are complete, so that no partial file outlives the process.
//
// This holds however the process ends, SIGKILL and crashes included: the file system reclaims a file without
// a name. A file gets its name at the end, between part_hold and part_release, which defer signals that would
// end the process; SIGKILL or a power cut at that time can only leave a complete file beside its destination.
#ifndef SIM_BASE_PART_FILE_H
#define SIM_BASE_PART_FILE_H

#include <stdbool.h>

typedef struct {
  int file;      // descriptor
  bool linkable; // can be given a name; else (some network and layered file systems) it is copied
} part_t;

// Creates a file without a name in that folder. False on an error, with errno set.
bool part_open(part_t *p, const char *folder);

// The same for file systems without nameless files: creates a file and removes its name at once.
bool part_open_unlinked(part_t *p, const char *folder);

// A second descriptor of the file, to write to and to close. -1 on an error, with errno set.
int part_writer(const part_t *p);

// Gives the file a name, whose last six letters XXXXXX are replaced, as by mkstemp. False on an error, with
// errno set; there is then no such file.
bool part_name(const part_t *p, char *name);

// Closes the file; one without a name is gone.
void part_close(part_t *p);

// Defer signals from part_hold to part_release, so that what happens between completes. Signals that are
// ignored (nohup) or have a handler keep their disposition.
void part_hold(void);
void part_release(void);

#endif
