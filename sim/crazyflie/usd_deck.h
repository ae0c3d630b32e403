// usd_deck.h - the uSD deck: what the firmware writes onto its card when the app triggers an event.
//
// As src/deck/drivers/src/usddeck.c does it (bitcraze/crazyflie-firmware 2a18fc29): the trigger writes a
// whole row into a buffer, which the card empties. A row that finds no room is lost without a trace in the
// file.
#ifndef CRAZYFLIE_USD_DECK_H
#define CRAZYFLIE_USD_DECK_H

#include "crazyflie.h"
#include "sections.h"
#include "usd_config.h"
#include <stdio.h>

// Speed of the card, and how long and how often it is busy with itself; all 0: it takes bytes as they come.
typedef struct {
  double speed_Bps, busy_s, busy_every_s;
} usd_card_t;

typedef struct usd_deck {
  usd_config_t config;
  usd_card_t card;
  FILE *to;            // not closed here
  int flights;         // started with this deck on board
  long asked, written; // rows
  // Not for callers.
  const section_log_t *log[USD_CONFIG_EVENTS][USD_CONFIG_VARIABLES];
  const crazyflie_t *vehicle;
  unsigned long crc;
  uint64_t last_us;
  double waiting; // bytes in the buffer
} usd_deck_t;

// Makes a deck with this config on its card, and writes the head of the file. BAD_INPUT as usd_config_read
// and usd_config_check.
MUST_CHECK done_t usd_deck_init(usd_deck_t *deck, const char *config_path, FILE *to, why_t *why);

// Puts the deck onto the vehicle, with usd.logging 1. A file has the rows of one flight: a second flight is
// only counted.
void usd_deck_start(usd_deck_t *deck, crazyflie_t *vehicle);

// usd.logging 0: writes the checksum, and the file is complete.
void usd_deck_stop(usd_deck_t *deck);

#endif
