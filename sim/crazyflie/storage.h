// storage.h - parameters that a client stores permanently: the vehicle's memory, as a text file.
#ifndef SIM_CRAZYFLIE_STORAGE_H
#define SIM_CRAZYFLIE_STORAGE_H

#include "firmware.h"

// One value for each parameter, by number; NaN: none is stored.
typedef struct {
  const char *path; // null: kept only while the program runs
  double *value;
  int n;
} storage_t;

// Reads the file, if there is one, and writes its values into the firmware's parameters. A parameter that
// does not exist any more, or cannot be stored, is left out, with a word on the console. BAD_INPUT: a line
// that is not "group.name = value", or a file that cannot be read or written. FAILED: no memory.
MUST_CHECK done_t storage_open(storage_t *s, const char *path, firmware_t *f, why_t *why);
void storage_close(storage_t *s);

// Writes the stored values into a firmware that is switched on anew.
void storage_restore(const storage_t *s, firmware_t *f);

// Stores a value; NaN deletes the stored one. False: the file could not be written, and nothing has changed.
bool storage_put(storage_t *s, const firmware_t *f, int param, double value);

#endif
