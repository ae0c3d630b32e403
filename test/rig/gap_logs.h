// gap_logs.h - flights of the exam (test/exam/flights.h) as log files, and the vehicle file that goes with
// them.
#ifndef TEST_RIG_GAP_LOGS_H
#define TEST_RIG_GAP_LOGS_H

#include "exam/flights.h"

// Writes a flight as CSV with the columns of tools/columns/fly.toml. Force and rates are late as the
// Crazyflie's filters make them.
void gap_log_write(const gap_flight_t *flight, const char *path);

// The same as a uSD log of floats.
void gap_log_write_usd(const gap_flight_t *flight, const char *path);

// Flies `n` flights of 20 s of the exam's vehicle with `hidden` (null: nothing) and writes NAME0.csv,
// NAME0.bin, NAME1.csv.. and room.toml, the vehicle file without the hidden effect, into the scratch folder.
// False: a flight crashed.
bool gap_logs_fly(const char *name, int n, const fx_use_t *hidden);

// Flies one flight of that seed and writes FILE and room.toml. indi: flown by the flight code. False: it
// crashed.
bool gap_logs_fly_one(const char *file, unsigned long seed, bool indi, const fx_use_t *hidden);

#endif
