// report.h - what a study found: gathered once, written as text, verdict.json, curves.csv and report.html.
#ifndef SIM_GAP_8_REPORT_REPORT_H
#define SIM_GAP_8_REPORT_REPORT_H

#include "base/text.h"
#include "gap/2_predict/lines.h"
#include "gap/6_extend/p_value.h"
#include "gap/study.h"
#include <cjson/cJSON.h>
#include <stdio.h>

#define REPORT_BINS    24
#define REPORT_TEXT    320
#define REPORT_LONG    1000
#define REPORT_NOTES   64
#define REPORT_NUMBERS (FX_SIZE_MAX + 2)

// A range of a coordinate, in its unit.
typedef struct {
  double from, to;
} interval_t;

// Means of one channel's held-out rows over bins of a coordinate.
typedef struct {
  int channel, coordinate;
  int n; // bins with enough rows
  double x[REPORT_BINS], rows[REPORT_BINS];
  double before[REPORT_BINS], after[REPORT_BINS]; // residual
  double effect[REPORT_BINS], low[REPORT_BINS],
      high[REPORT_BINS]; // what the effect adds; this minus and plus its standard error
} profile_t;

// How sure a name is. Ambiguous: other effects explain as much, or the set points as instrument say that
// feedback may make it. Likely: neither, but more than noise is left in its channel, what noise leaves is
// unknown, or the held-out flights do not bear it out. Strong: none of these.
typedef enum { STANDS_AMBIGUOUS, STANDS_LIKELY, STANDS_STRONG } standing_t;
extern const char *const standing_name[];

// Bound on the rms residual that the extended model leaves, over the floor (what noise and feedback alone
// leave). Above it there is a gap, named or not. If the floor exceeds the original model's residual by as
// much, it is not the floor of this log.
#define LEFT_OVER 2.0
// Bound on the share of the squares of a residual's increments that comes in jumps: above it something
// changed in flight. At three quarters the residual would be half as large without its jumps, but nominal
// flights that were disturbed by all of it have as high a floor.
#define LEFT_JUMPS (1.0 - 1.0 / (LEFT_OVER * LEFT_OVER))
typedef enum { LEFT_UNKNOWN, LEFT_QUIETER, LEFT_NOISE, LEFT_MORE } left_over_t;
extern const char *const left_name[];

// One number of a named effect: first its sizes, then its shape and its kind, if it has them.
typedef struct {
  const fx_param_t *param;
  double value, stderr_; // both NaN: no residual of these flights shows it
  const char *no_stderr; // why it has no standard error; null: it has one
  double in_file;        // its value in the vehicle file; NaN: none
  double by_instrument;  // estimate with the set points as instrument; only for sizes, if tried
} number_t;

// Returns the unit to print: none for a whole number that was chosen among a few.
static inline const char *report_unit(const number_t *k) {
  return k->no_stderr && fx_is_number(k->param) ? "" : k->param->unit;
}

// One named effect.
typedef struct {
  const named_t *named;
  const fx_use_t *use;     // as in the extended model
  const fx_use_t *in_file; // as in the vehicle file; null: not there. named->value is the difference
  const fx_t *fx;
  const char *name; // as printed (candidate_name)
  int from, to;     // the name is about the sizes from..to-1
  int n_number;
  number_t number[REPORT_NUMBERS];
  interval_t where; // range of the profile's coordinate with the middle 90 % of the effect's sum of squares
  profile_t profile;
  // Where the effect matters, in the same coordinate and channel: within 7 cm of a surface, else `where`.
  interval_t matters;
  double before, after;         // rms of the held-out rows in `matters`
  standing_t standing;          // how sure the name is
  char family[REPORT_TEXT];     // the name and its rivals: "mass, thrust_scale or accel_bias"
  char fly[REPORT_TEXT];        // flight that would tell it from its rivals, or show it better
  char says[REPORT_TEXT];       // what it does: "lift is short by 0.79 +- 0.02 m/s2, 8 % of g"
  char instrument[REPORT_TEXT]; // what the set points as instrument say of it; empty: not tried
} finding_t;

// The probability that the name or a rival is there, as printed; NaN: not computed. At most REPORT_SURE,
// because no exam is long enough to check more.
#define REPORT_SURE 0.999
static inline double report_probability(const finding_t *f) {
  return f->named->probability > REPORT_SURE ? REPORT_SURE : f->named->probability;
}

// An effect that these flights cannot tell.
typedef struct {
  const fx_t *fx;
  char why[REPORT_TEXT];
  bool flyable; // other flights could tell it
} untested_t;

// An effect that these flights would have shown at its typical size, and the smallest size that they would.
typedef struct {
  const fx_t *fx;
  const fx_param_t *param;
  double from;
  bool in_file; // `from` is a difference from the vehicle file
} shown_t;

// Sentences for people.
typedef struct {
  int n;
  char line[REPORT_NOTES][REPORT_LONG];
} notes_t;

typedef struct {
  const study_t *study;
  const char *verdict; // "named", "none", "unknown"
  int n_finding, n_untested, n_shown;
  finding_t finding[NAMED_MAX];
  untested_t untested[FX_MAX];
  shown_t shown[FX_MAX];
  notes_t fitness, to_do, warnings; // do the flights fit the question; what to do now; the rest
  profile_t left;                   // over the coordinate of the largest cell of what is left
  lines_t before, after;            // residuals of the held-out rows without each flight's own
  double *own;            // its own: taken out of `after`, [flight * CHANNELS + channel] (verify_lines)
  bool ceiling_suspected; // lift grows towards the greatest heights, and the vehicle file has no ceiling
  double ceiling_seen_m;  // its height by the upward range sensor; NaN: not seen
} report_t;

// Gathers what the outputs say. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t report_make(report_t *r, study_t *study, why_t *why);
void report_free(report_t *r);

// --- parts of it ------------------------------------------------------------------------------------------

// Finds where each name shows in the held-out flights, its numbers and how sure it is. FAILED: no memory.
MUST_CHECK done_t report_take_evidence(report_t *r, study_t *study, why_t *why);
// Says whether these flights fit the question. FAILED: no memory.
MUST_CHECK done_t report_take_fitness(report_t *r, why_t *why);
void report_warn(report_t *r);
void report_advise(report_t *r);

// Adds a sentence.
#define note(notes, ...) text_line((notes)->line, (notes)->n, __VA_ARGS__)

// Fills a finding's numbers and texts. effect: what it adds to each row of its profile's channel.
void report_describe(const report_t *r, finding_t *f, const double *effect, int rows);

// Returns the range of a coordinate over these rows without the share `outside` of them at each end; NaN if
// no row has the coordinate.
interval_t report_span(const set_t *s, const rows_t *rows, const model_t *m, int coordinate, double outside);

// --- what several outputs say -----------------------------------------------------------------------------

#define FLIGHTS_TOLD 6 // flights in one line, at most: more are no help

// Returns the file name of a log; its whole path if another log has the same file name.
const char *report_log_name(const report_t *r, const gap_flight_t *log);
// Writes what to fly to tell the two apart; if neither says it, what shows each.
void report_apart(const fx_t *fx, const fx_t *rival, char text[REPORT_TEXT]);
// Writes where a cell is: "at height 0.4 to 0.6 m", "at time 3.00 to 3.04 s of a.csv". Returns text.
#define REPORT_PLACE 192
const char *report_place(const report_t *r, const cell_t *cell, char text[REPORT_PLACE]);
// Writes a cell's size and place: "+0.24 +- 0.005 m/s2 in force_y, at height 0.4 to 0.6 m". Returns text.
#define REPORT_CELL 288
const char *report_cell(const report_t *r, const cell_t *cell, char text[REPORT_CELL]);
// Writes how flights differ: "force_y is another in each flight, about the mean of all: -0.06 in a.csv, +0.13
// in b.csv, +- 0.003 m/s2; .. it acts as ..". Returns text.
#define REPORT_DIFFER 1536
const char *report_differ(const report_t *r, const flights_differ_t *d, char text[REPORT_DIFFER]);
// A list by held-out flight: "-1.2 m/s2 in c.csv, +0.3 m/s2 in d.csv", and ", .." for those after
// FLIGHTS_TOLD.
typedef struct {
  int n;
  char text[REPORT_TEXT];
} of_flights_t;
void report_add_flight(of_flights_t *to, const report_t *r, int channel, int flight, double value);
// Warns of constants that are taken out of held-out flights as their own, if they are more than noise.
void report_warn_of_own(report_t *r);
// Writes which effects would explain the residual for a time: "at all times but 0.3 to 15.1 s it acts as mass
// would (add 0.0031 kg: 97 % of what is there more)". Returns text.
#define REPORT_FOR_A_TIME 512
const char *report_for_a_time(const for_a_time_t *f, char text[REPORT_FOR_A_TIME]);
// Writes "12.3 mm", or metres from 1 m on. Returns text.
#define REPORT_LENGTH 24
const char *report_length(double m, char text[REPORT_LENGTH]);
// Writes the answer where no effect is named. vehicle: the vehicle's name in the answer; null: left out.
void report_headline(const report_t *r, const char *vehicle, FILE *out);

extern const char *const report_feedback[]; // by confirm_answer_t
// Returns the extended model's white sum of squares over the original model's, on the fitted flights.
double report_left(const report_t *r);
// True if a residual of the held-out flights can be formed.
bool report_has_residual(const report_t *r);
// True if a channel of the turning is left out in flights whose rows miss commands.
bool report_turning_missed(const report_t *r);
// True if, besides a residual, something is named or it is known what feedback alone leaves; else nothing
// could have been found.
bool report_can_tell(const report_t *r);
// True if the names do not explain the held-out flights better, all channels together.
bool report_contradicted(const report_t *r);
standing_t report_standing(const report_t *r, const finding_t *f);
left_over_t report_adequacy(const report_t *r, int channel);
left_over_t report_adequacy_of_all(const report_t *r); // of the worst channel

// --- the outputs ------------------------------------------------------------------------------------------

// Returns verdict.json: {"verdict", "effects", "unknown", "gap", "adequacy", "already_in_model",
// "resimulation", "not_testable", "would_show", "to_do", "refused", "warnings", "made"}; null: no memory. An
// effect's "matters": {"channel", "unit", "from", "to", "before", "after"}, as in finding_t.
cJSON *report_verdict(const report_t *r);
// Returns the verdict `refused`, with the line that says why as its only warning; null: no memory.
cJSON *report_refused(const char *line, const study_order_t *order);
// FAILED: no memory for the text.
MUST_CHECK done_t report_write_json(const cJSON *json, FILE *out, why_t *why);

// Writes the verdict in words, one screen.
void report_words(const report_t *r, FILE *out);

// Writes curves.csv: the numbers of the page's pictures of named effects, one row for each bin.
void report_curves(const report_t *r, FILE *out);

// Writes report.html, a self-contained page.
void report_page(const report_t *r, FILE *out);
void report_page_refused(const char *line, const study_order_t *order, FILE *out);

#endif
