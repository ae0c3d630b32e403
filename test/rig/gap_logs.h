// gap_logs.h - flights of the exam (test/exam/flights.h) as log files, and the vehicle file that goes with
// them.
#ifndef TEST_RIG_GAP_LOGS_H
#define TEST_RIG_GAP_LOGS_H

#include "exam/flights.h"

// Writes a flight as CSV with the columns of tools/columns/fly.toml, force and rates late as its filters make
// them.
void gap_log_write(const gap_flight_t *flight, const char *path);

// The same as a uSD log, in floats.
void gap_log_write_usd(const gap_flight_t *flight, const char *path);

// Flies `n` flights of 20 s of the exam's vehicle with `hidden` (null: nothing) and writes them as NAME0.csv,
// NAME0.bin, NAME1.csv.. into the scratch folder, with room.toml, the vehicle file without it. False: it
// crashed.
bool gap_logs_fly(const char *name, int n, const fx_use_t *hidden);

// One flight of that seed, written as FILE beside room.toml; indi: flown by the flight code. False: it
// crashed.
bool gap_logs_fly_one(const char *file, unsigned long seed, bool indi, const fx_use_t *hidden);

#endif
