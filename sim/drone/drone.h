// drone.h - one simulated Crazyflie that clients fly: plant, sensors and estimator around firmware and link.
//
// Ticks of 2 ms, in simulated time only: pace and transport of packets are the caller's. The same packets at
// the same ticks make the same flight, to the bit.
#ifndef SIM_DRONE_DRONE_H
#define SIM_DRONE_DRONE_H

#include "drone/disturbed.h"
#include "flight/loop.h"
#include "link/link.h"
#include <stdio.h>

typedef struct {
  scene_t scene; // its own copy
  plan_t plan;
  pilot_t pilot;
  firmware_t firmware;
  link_t link;
  storage_t storage;
  flight_loop_t *loop;
  drawn_t drawn;
  tick_t seen; // newest sample
  bool has_seen;
  bool finite; // false: its state is not finite, and it stands still
  desk_params_t params, was;
  disturbed_t disturbed;
  desk_logs_t logs;
  record_t record; // samples not yet written
  FILE *log;       // flight, as fly writes it; null: none
  FILE *commands;  // packets of the client, "MS HEX" a line, "MS" where it left; null: none
  // Not for callers.
  firmware_more_t more;
  double initial[DESK_PARAMS_MAX];
  const char *stored; // path of the storage's file
  bool reset_asked;
  uint32_t now_ms, on_ms; // since drone_open; since it was switched on
} drone_t;

// Makes *d a vehicle that is switched on and stands on the floor. storage: path of the file of stored
// parameters, or null. log and commands are the caller's to close; *d must stay where it is. BAD_INPUT: a
// vehicle that cannot fly, or a storage file that is none. FAILED: no memory.
MUST_CHECK done_t drone_open(drone_t *d, const scene_t *scene, const char *storage, FILE *log, FILE *commands,
                             why_t *why);
// Writes the rest of the log. FAILED: the log or the commands could not be written.
MUST_CHECK done_t drone_close(drone_t *d, why_t *why);

// Time since drone_open, restarts included; the firmware's own clock begins anew with each.
uint32_t drone_now_ms(const drone_t *d);

// Number of the first parameter of the group desk, among all.
int drone_first_param(const drone_t *d);

// Takes a packet of the client, now.
void drone_take(drone_t *d, const uint8_t *bytes, int size);

// Tells it that the client has gone, now.
void drone_left(drone_t *d);

// Runs the next 2 ms. FAILED: no memory, or a log cannot be written.
MUST_CHECK done_t drone_tick(drone_t *d, why_t *why);

// Sets a desk parameter for somebody other than the client, and tells the client. BAD_INPUT: says what is
// allowed.
MUST_CHECK done_t drone_set(drone_t *d, const char *name, double value, why_t *why);

// Flies a recorded file of commands anew, to its end and more_s beyond; lines that begin with # are comments.
// The storage's file is not written. BAD_INPUT: not such a file. FAILED: as drone_tick.
MUST_CHECK done_t drone_replay(drone_t *d, FILE *commands, const char *path, double more_s, why_t *why);

#endif
