// place.h - one vehicle at the desk: what flies, its link over UDP, and the files written of it.
#ifndef SIM_DESK_PLACE_H
#define SIM_DESK_PLACE_H

#include "base/made.h"
#include "desk/datagrams.h"
#include "drone/drone.h"

#define PLACE_PATH    512
#define PLACE_BOOT_MS 1000 // flown before it answers, so that it has passed its checks and is armed

// What all vehicles of the desk share.
typedef struct {
  const scene_t *scene;
  struct in_addr address;
  int port;            // of the first vehicle; the others have the next ones. 0: any that is free
  const char *storage; // file in which the first keeps what a client stores; null: none keeps it
  const char *log;     // the folder of the logs; null: none
  // For the logs: how this program was called, the part of it that fly takes too, the scene's file (or null).
  const made_t *made, *again;
  const char *scene_path;
} place_order_t;

typedef struct {
  drone_t drone;
  datagrams_t radio;
  FILE *log, *commands;
  char log_path[PLACE_PATH], commands_path[PLACE_PATH];
  char uri[64]; // as a client on this machine names it
} place_t;

// Opens vehicle `number`, 0 the first: switched on, and ready. BAD_INPUT: the port or the files cannot be
// had. FAILED: memory, disk. *p must stay where it is; on error there is nothing to close.
MUST_CHECK done_t place_open(place_t *p, const place_order_t *o, int number, why_t *why);

// FAILED: a file is not whole.
MUST_CHECK done_t place_close(place_t *p, why_t *why);

// Takes what clients sent, and flies on to until_s of the vehicle's own time, but at most 20 ms, so that the
// others get their turn. FAILED: as drone_tick.
MUST_CHECK done_t place_fly(place_t *p, double wall_s, double until_s, why_t *why);

// Flushes what is written to the disk. FAILED: that failed.
MUST_CHECK done_t place_flush(place_t *p, why_t *why);

#endif
