// report.h - what a study found: gathered once, and told in words, as verdict.json and as report.html.
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

// Where an effect does most of what it does; a picture shows that and what is beside it.
typedef struct {
  double from, to;
} interval_t;

// Means over ranges of a coordinate, held-out rows of one channel.
typedef struct {
  int channel, coordinate;
  int n; // ranges that hold rows enough
  double x[REPORT_BINS], rows[REPORT_BINS];
  double before[REPORT_BINS], after[REPORT_BINS]; // residual
  double effect[REPORT_BINS], low[REPORT_BINS],
      high[REPORT_BINS]; // what the effect adds, less and more by its standard error
} profile_t;

// How sure a name is. Ambiguous: others do as well, or the set points say that it may be feedback. Likely: no
// other does, but more is left in its channel than noise, or nobody knows what noise leaves. Strong: neither.
typedef enum { STANDS_AMBIGUOUS, STANDS_LIKELY, STANDS_STRONG } standing_t;
extern const char *const standing_name[];

// What the extended model leaves of a channel beside what noise and feedback alone leave, the floor. So many
// times it: there is a gap, whatever could be named; the other way round: the floor is not that of this log.
#define LEFT_OVER 2.0
// Or something changed in flight: without its jumps a residual whose increments have them for three quarters
// of their squares would be half as large, and nominal flights that were shaken by all of it have a floor as
// high.
#define LEFT_JUMPS (1.0 - 1.0 / (LEFT_OVER * LEFT_OVER))
typedef enum { LEFT_UNKNOWN, LEFT_QUIETER, LEFT_NOISE, LEFT_MORE } left_over_t;
extern const char *const left_name[];

// One number of a name: a size, then its shape and its kind, if it has them.
typedef struct {
  const fx_param_t *param;
  double value, stderr_; // both NaN: nothing that can be compared of these flights shows it
  const char *no_stderr; // why it has none; null: it has
  double in_file;        // as the vehicle file has it; NaN: it has it not
  double by_instrument;  // as the set points say; only of sizes, where they were tried
} number_t;

// A choice among a few has no unit for people.
static inline const char *report_unit(const number_t *k) {
  return k->no_stderr && fx_is_number(k->param) ? "" : k->param->unit;
}

// One named effect.
typedef struct {
  const named_t *named;
  const fx_use_t *use;     // as the new model has it
  const fx_use_t *in_file; // as the vehicle file has it; null: it has it not. named->value is the difference
  const fx_t *fx;
  const char *name; // for people (candidate_name)
  int from, to;     // of its sizes, those that the name is about
  int n_number;
  number_t number[REPORT_NUMBERS];
  interval_t where; // of the profile's coordinate: there lie the middle 90 % of its sum of squares
  profile_t profile;
  // Where it matters, over the same coordinate and channel: closer than 7 cm for a surface, else `where`.
  interval_t matters;
  double before, after;         // rms of the held-out rows there
  standing_t standing;          // how sure the name is
  char family[REPORT_TEXT];     // the name and its rivals: "mass, thrust_scale or accel_bias"
  char fly[REPORT_TEXT];        // what would tell it from its rivals, or show it better
  char says[REPORT_TEXT];       // what it does: "lift is short by 0.79 +- 0.02 m/s2, 8 % of g"
  char instrument[REPORT_TEXT]; // what the set points as the instrument say of it; empty: not tried
} finding_t;

// Of the name or a rival, as it is told; NaN: it was not worked out. No exam is long enough to tell more.
#define REPORT_SURE 0.999
static inline double report_probability(const finding_t *f) {
  return f->named->probability > REPORT_SURE ? REPORT_SURE : f->named->probability;
}

// An effect that these flights cannot tell.
typedef struct {
  const fx_t *fx;
  char why[REPORT_TEXT];
  bool flyable; // other flights could
} untested_t;

// An effect that these flights would have shown at its typical size, and from which size on.
typedef struct {
  const fx_t *fx;
  const fx_param_t *param;
  double from;
  bool in_file; // as a difference from what the vehicle file has
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
  notes_t fitness, to_do, warnings; // are these flights fit for the question; use, add, fly; all else
  profile_t left;                   // over the coordinate of the largest cell of what is left
  lines_t before, after;            // held-out rows, without
  double *own;                      // what each flight has of its own (verify_lines)
  bool ceiling_suspected; // lift grows towards the greatest heights, and the vehicle file has no ceiling
  double ceiling_seen_m;  // by an upward range sensor; NaN: it was not
} report_t;

// Works out what is to be said. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t report_make(report_t *r, study_t *study, why_t *why);
void report_free(report_t *r);

// --- parts of it ------------------------------------------------------------------------------------------

// Where each name shows in the held-out flights, its numbers, how sure it is. FAILED: no memory.
MUST_CHECK done_t report_take_evidence(report_t *r, study_t *study, why_t *why);
// FAILED: no memory.
MUST_CHECK done_t report_take_fitness(report_t *r, why_t *why);
void report_warn(report_t *r);
void report_advise(report_t *r);

// One sentence more.
#define note(notes, ...) text_line((notes)->line, (notes)->n, __VA_ARGS__)

// What a finding says of itself. effect: what it adds to the rows of its profile's channel.
void report_describe(const report_t *r, finding_t *f, const double *effect, int rows);

// The coordinate of these rows without the outermost, so much of them on each side; 0 to 0: it is not there.
interval_t report_span(const set_t *s, const rows_t *rows, const model_t *m, int coordinate, double outside);

// --- what several outputs say -----------------------------------------------------------------------------

#define FLIGHTS_TOLD 6 // of more a line is no help

// What stands behind the last slash of a log's path; all of it where another log has that name, too.
const char *report_log_name(const report_t *r, const gap_flight_t *log);
// What to fly to tell the two apart; pairs of which neither says it: what shows each.
void report_apart(const fx_t *fx, const fx_t *rival, char text[REPORT_TEXT]);
// Where a cell is: "at height 0.4 to 0.6 m". Returns text.
#define REPORT_PLACE 96
const char *report_place(const cell_t *cell, char text[REPORT_PLACE]);
// What is there, too: "+0.24 +- 0.005 m/s2 in force_y, at height 0.4 to 0.6 m". Returns text.
#define REPORT_CELL 192
const char *report_cell(const cell_t *cell, char text[REPORT_CELL]);
// "force_y is another in each flight, about the mean of all: -0.06 in a.csv, +0.13 in b.csv, +- 0.003 m/s2;
// it acts as .." Returns text.
#define REPORT_DIFFER 1536
const char *report_differ(const report_t *r, const flights_differ_t *d, char text[REPORT_DIFFER]);
// What held-out flights have: "-1.2 m/s2 in c.csv, +0.3 m/s2 in d.csv", and ", .." for more than are told.
typedef struct {
  int n;
  char text[REPORT_TEXT];
} of_flights_t;
void report_add_flight(of_flights_t *to, const report_t *r, int channel, int flight, double value);
// Notes what is left out of held-out flights, where it is more than noise.
void report_warn_of_own(report_t *r);
// What would do for it for a time: "At all times but 0.3 to 15.1 s it acts as mass would (add 0.0031 kg: 97 %
// of what is there more)". Returns text.
#define REPORT_FOR_A_TIME 512
const char *report_for_a_time(const for_a_time_t *f, char text[REPORT_FOR_A_TIME]);
// "12.3 mm", or in metres from 1 m on. Returns text.
#define REPORT_LENGTH 24
const char *report_length(double m, char text[REPORT_LENGTH]);
// The answer where nothing is named; vehicle: what nothing is missing in, null: not said.
void report_headline(const report_t *r, const char *vehicle, FILE *out);

extern const char *const report_feedback[]; // by confirm_answer_t
// The part of the original model's white sum of squares that the extended one leaves, of the fitted flights.
double report_left(const report_t *r);
// Some residual can be formed.
bool report_has_residual(const report_t *r);
// ... and it is known what feedback alone makes of it; else nothing could have been found.
bool report_can_tell(const report_t *r);
// Held-out flights are explained no better with what is named, all channels together.
bool report_contradicted(const report_t *r);
standing_t report_standing(const report_t *r, const finding_t *f);
left_over_t report_adequacy(const report_t *r, int channel);
left_over_t report_adequacy_of_all(const report_t *r); // the worst

// --- the outputs ------------------------------------------------------------------------------------------

// verdict.json: {"verdict", "effects", "unknown", "gap", "resimulation", "not_testable", "warnings"}; an
// effect has "matters" besides: {"channel", "unit", "from", "to", "before", "after"}, as finding_t. A null
// pointer: no memory.
cJSON *report_verdict(const report_t *r);
// The verdict `refused`, with the line that says why as its one warning.
cJSON *report_refused(const char *line, const study_order_t *order);
// FAILED: no memory for the text.
MUST_CHECK done_t report_write_json(const cJSON *json, FILE *out, why_t *why);

// One screen.
void report_words(const report_t *r, FILE *out);

// The numbers of the page's pictures of named effects: a row for each mean over a range of the coordinate.
void report_curves(const report_t *r, FILE *out);

// A page that needs nothing else.
void report_page(const report_t *r, FILE *out);
void report_page_refused(const char *line, const study_order_t *order, FILE *out);

#endif
