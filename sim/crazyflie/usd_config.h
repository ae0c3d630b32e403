// usd_config.h - the file config.txt on the card of the Crazyflie's uSD deck, read as the deck reads it.
//
//   One item a line: version (1), buffer in bytes, file name, 1 to start at power-on; then for each event
//   `on:NAME` and its variables. After on:fixedFrequency come the frequency in Hz and the mode: 0, 1 (in the
//   stabilizer's task) or 2 (in a task of its own). White space is ignored, and so is # with all after it.
//
// The deck skips what it does not know or has no room for; here it is refused.
#ifndef CRAZYFLIE_USD_CONFIG_H
#define CRAZYFLIE_USD_CONFIG_H

#include "base/error.h"
#include <stdbool.h>

#define USD_CONFIG_EVENTS    20
#define USD_CONFIG_VARIABLES 20 // of an event
#define USD_CONFIG_LINE      32 // the deck's buffer of a line, with the final 0
#define USD_CONFIG_FILE      10 // letters of the file name before its digits

typedef struct {
  char name[USD_CONFIG_LINE];
  int line; // its line in the file
  int n;
  char variable[USD_CONFIG_VARIABLES][USD_CONFIG_LINE];
  int at[USD_CONFIG_VARIABLES]; // lines of the file
} usd_config_event_t;

typedef struct {
  int buffer_bytes;
  char file[USD_CONFIG_FILE + 1];
  bool at_start;
  int frequency_Hz, mode; // of fixedFrequency; 0: none
  int n;
  usd_config_event_t event[USD_CONFIG_EVENTS];
} usd_config_t;

// BAD_INPUT, with file and line: it cannot be read, is no such file, or holds more than the deck takes.
MUST_CHECK done_t usd_config_read(const char *path, usd_config_t *config, why_t *why);

// BAD_INPUT, with file and line: the app triggers no such event, or has no such log.
MUST_CHECK done_t usd_config_check(const char *path, const usd_config_t *config, why_t *why);

#endif
