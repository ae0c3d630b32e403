// summary.h - statistics of many flights of one command, in a line that does not grow with their number.
//
// A cell is one command without its seeds: `fly close-flight --controller indi --noise real`, its options in
// the order given, because a later one overrides an earlier one. For each number of a flight's result
// (result.h), of a segment or of the whole flight, it knows how many flights have it, mean, least, most, and
// any quantile to 1.6 % (for sizes of 2^-10 to 2^20). Counts are integers, sums are integer steps of 2^-20 of
// the number's unit, and quantiles come from bins. So two summaries join to what one run would have written,
// to the byte, however the seeds were divided. It also knows its seeds, so that none counts twice.
//
// A file is JSON lines, one for each cell, at most SUMMARY_CELLS_MAX.
#ifndef SIM_FLIGHT_SUMMARY_H
#define SIM_FLIGHT_SUMMARY_H

#include "base/error.h"
#include <cjson/cJSON.h>
#include <stdint.h>
#include <stdio.h>

// Bins: for either sign 32 of equal width in every octave of 2^-10 to 2^20, and one for what is nearer to
// zero; what is beyond counts in the outermost one.
#define SUMMARY_OCTAVES 30
#define SUMMARY_FINE    32
#define SUMMARY_SIDE    (SUMMARY_OCTAVES * SUMMARY_FINE)
#define SUMMARY_BINS    (2 * SUMMARY_SIDE + 1)

#define SUMMARY_CELLS_MAX 1000 // a megabyte each

#define SUMMARY_STEP  0x1p-20 // of a sum, in the number's unit: a mean is off by less than 1e-6
#define SUMMARY_LIMIT 0x1p+20 // larger numbers count as this, so that the sum of eight million fits

typedef struct {
  char name[48];            // "03.rms_mm": of the third segment; "all.contacts": of the flight
  int64_t flights;          // that have this number; in the others it is NaN
  int64_t sum;              // in steps of 2^-20
  double least, most;       // HUGE_VAL and -HUGE_VAL where no flight has it
  int64_t in[SUMMARY_BINS]; // from the lowest bin to the highest
} measure_t;

typedef struct {
  uint64_t from, to; // both included
} seeds_t;

typedef struct {
  char *cell, *by;    // the command; program and version
  seeds_t *seeds;     // ascending, disjoint and not adjacent
  measure_t *measure; // sorted by name
  int n_seeds, n_measure;
  int64_t flights, not_finite, touched; // touched: with a contact at least
} summary_t;

// Makes a summary of no flight. FAILED: no memory. Free it even after an error.
MUST_CHECK done_t summary_make(summary_t *s, const char *cell, const char *by, why_t *why);
void summary_free(summary_t *s);

// Adds a flight's result. BAD_INPUT: its seed is there already. FAILED: no memory, or a number's name is too
// long for measure_t.
MUST_CHECK done_t summary_add(summary_t *s, uint64_t seed, const cJSON *result, why_t *why);

// Adds all flights of another summary. BAD_INPUT: another version flew them (a `+` behind a version, for
// uncommitted changes, does not tell which), a seed is in both, or a sum overflows; nothing is added then.
// FAILED: no memory.
MUST_CHECK done_t summary_join(summary_t *s, const summary_t *more, why_t *why);

// Returns the quantile at share, 0 to 1: the middle of its bin, within least and most. NaN where no flight
// has the number.
double summary_quantile(const measure_t *m, double share);
double summary_mean(const measure_t *m); // likewise

// Writes one line. FAILED: no memory.
MUST_CHECK done_t summary_write(const summary_t *s, FILE *out, why_t *why);

// Reads such a line. BAD_INPUT: it is none, or its counts do not add up. FAILED: no memory.
MUST_CHECK done_t summary_read(summary_t *s, const char *line, why_t *why);

// Prints for people the cell, its flights, and a row for each number.
void summary_print(const summary_t *s, FILE *out);

// Reads the cells of a file into all[0..*n), sorted by name; a cell that is there already is joined.
// BAD_INPUT, with file and line: as summary_read and summary_join, or there are too many cells.
MUST_CHECK done_t summary_gather(summary_t *all, int *n, const char *path, why_t *why);

#endif
