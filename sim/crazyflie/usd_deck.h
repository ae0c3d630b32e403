// usd_deck.h - the uSD deck: what the firmware writes onto its card when the app triggers an event.
//
// As src/deck/drivers/src/usddeck.c does it (bitcraze/crazyflie-firmware 2a18fc29): a row whole, while the
// event is triggered, into a buffer that the card empties; a row for which there is no room is lost without a
// trace in the file.
#ifndef CRAZYFLIE_USD_DECK_H
#define CRAZYFLIE_USD_DECK_H

#include "crazyflie.h"
#include "sections.h"
#include "usd_config.h"
#include <stdio.h>

// How fast the card takes bytes, and how long it is busy with itself how often; all 0: as fast as they come.
typedef struct {
  double speed_Bps, busy_s, busy_every_s;
} usd_card_t;

typedef struct usd_deck {
  usd_config_t config;
  usd_card_t card;
  FILE *to;            // not closed here
  int flights;         // that began with this deck on board
  long asked, written; // rows
  // Not for callers.
  const section_log_t *log[USD_CONFIG_EVENTS][USD_CONFIG_VARIABLES];
  const crazyflie_t *vehicle;
  unsigned long crc;
  uint64_t last_us;
  double waiting; // bytes in the buffer
} usd_deck_t;

// A deck with this config on its card and an empty file. BAD_INPUT as usd_config_read and
// usd_config_check.
MUST_CHECK done_t usd_deck_init(usd_deck_t *deck, const char *config_path, FILE *to, why_t *why);

// Onto the vehicle, and usd.logging 1. The rows of one flight make one file: a second flight is counted, no
// more.
void usd_deck_start(usd_deck_t *deck, crazyflie_t *vehicle);

// usd.logging 0: the file is whole.
void usd_deck_stop(usd_deck_t *deck);

#endif
