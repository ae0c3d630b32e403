// storage.h - parameters that a client stores for good: the vehicle's memory, as a text file.
#ifndef SIM_CRAZYFLIE_STORAGE_H
#define SIM_CRAZYFLIE_STORAGE_H

#include "firmware.h"

// One value a parameter, by number; NaN: none.
typedef struct {
  const char *path; // null: forgotten with the program
  double *value;
  int n;
} storage_t;

// Reads the file, if there is one, and writes what it holds into the firmware's parameters. One that is not
// there any more is left out, with a word on the console. BAD_INPUT: a line that is no "group.name = value",
// a file that cannot be read or written. FAILED: no memory.
MUST_CHECK done_t storage_open(storage_t *s, const char *path, firmware_t *f, why_t *why);
void storage_close(storage_t *s);

// Into a firmware that is switched on anew.
void storage_restore(const storage_t *s, firmware_t *f);

// Value NaN forgets it. False: it could not be written; nothing has changed then.
bool storage_put(storage_t *s, const firmware_t *f, int param, double value);

#endif
