// summary.h - what many flights of one command came to, in a line that does not grow with their number.
//
// A cell is one command but for its seeds: `fly close-flight --controller indi --noise real`, its options in
// the order given, as a later one overrides an earlier one. Of each number
// that a flight's result has (result.h), of a segment or of the whole flight: how many flights have it, mean,
// least, most, and any quantile to 1.6 % (between 2^-10 and 2^20 in size). Counts are whole, sums are whole
// steps of 2^-20 of the number's unit, and quantiles are those of bins, so that two summaries join to what
// one run would have said, to the byte, however the seeds were handed out. Which seeds are in it is known:
// none counts twice.
//
// A file is JSON lines, one a cell, at most SUMMARY_CELLS_MAX.
#ifndef SIM_FLIGHT_SUMMARY_H
#define SIM_FLIGHT_SUMMARY_H

#include "base/error.h"
#include <cjson/cJSON.h>
#include <stdint.h>
#include <stdio.h>

// Bins: 32 of equal width in every octave of 2^-10 to 2^20 of either sign, one for what is nearer to zero;
// what is beyond counts in the last one.
#define SUMMARY_OCTAVES 30
#define SUMMARY_FINE    32
#define SUMMARY_SIDE    (SUMMARY_OCTAVES * SUMMARY_FINE)
#define SUMMARY_BINS    (2 * SUMMARY_SIDE + 1)

#define SUMMARY_CELLS_MAX 1000 // a megabyte each

#define SUMMARY_STEP  0x1p-20 // of a sum, in the number's unit: a mean is off by less than 1e-6
#define SUMMARY_LIMIT 0x1p+20 // a number beyond counts as this: the sum of eight million has room

typedef struct {
  char name[48];            // "03.rms_mm": of the third segment; "all.contacts": of the flight
  int64_t flights;          // that have it; of the others it is not a number
  int64_t sum;              // in steps of 2^-20
  double least, most;       // infinite, the wrong way round, where no flight has it
  int64_t in[SUMMARY_BINS]; // from the lowest bin to the highest
} measure_t;

typedef struct {
  uint64_t from, to; // both are in it
} seeds_t;

typedef struct {
  char *cell, *by;    // the command; program and version
  seeds_t *seeds;     // apart from each other, in their order
  measure_t *measure; // by name
  int n_seeds, n_measure;
  int64_t flights, not_finite, touched; // touched: a contact at least
} summary_t;

// Of no flight. FAILED: no memory. Free it, also then.
MUST_CHECK done_t summary_make(summary_t *s, const char *cell, const char *by, why_t *why);
void summary_free(summary_t *s);

// One flight more, and its result. BAD_INPUT: its seed is in it. FAILED: no memory, or a number's name is too
// long for a measure's.
MUST_CHECK done_t summary_add(summary_t *s, uint64_t seed, const cJSON *result, why_t *why);

// All of another one's flights more. BAD_INPUT: another version flew (a `+` behind it, files that were
// changed and not committed, does not tell which), or a seed is in both; nothing is added then. FAILED: no
// memory.
MUST_CHECK done_t summary_join(summary_t *s, const summary_t *more, why_t *why);

// The middle of the bin in which so much of the flights lie below, within least and most. share: 0 to 1. NaN
// where no flight has it.
double summary_quantile(const measure_t *m, double share);
double summary_mean(const measure_t *m); // likewise

// One line. FAILED: no memory.
MUST_CHECK done_t summary_write(const summary_t *s, FILE *out, why_t *why);

// Of such a line. BAD_INPUT: it is none, or what it counts does not add up. FAILED: no memory.
MUST_CHECK done_t summary_read(summary_t *s, const char *line, why_t *why);

// For people: the cell, its flights, and a row for each number.
void summary_print(const summary_t *s, FILE *out);

// Reads the cells of a file into all[0..*n), by name: those that are there already are joined. BAD_INPUT,
// with file and line: as summary_read and summary_join, or there are too many cells.
MUST_CHECK done_t summary_gather(summary_t *all, int *n, const char *path, why_t *why);

#endif
