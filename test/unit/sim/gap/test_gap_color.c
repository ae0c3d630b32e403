// test_gap_color.c - white rows, what flights have for their own in them, and what that does to errors.
#include "base/random.h"
#include "gap/2_predict/color.h"
#include "gap/5_infer/evidence.h"
#include "rig/gap_rows.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

enum { FLIGHTS = 3, EACH = 400, ROWS = FLIGHTS * EACH };

typedef struct {
  int flight[ROWS];
  bool follows[ROWS];
  double lift[ROWS], v[ROWS];
  rows_t r;
} flights_t;

// White noise of sd 1, a constant of each flight's own times the lift, if that counts.
static flights_t *flights_of(const double own[FLIGHTS], bool lifts) {
  flights_t *const f = calloc(1, sizeof *f);
  random_t *const random = random_open(5);
  if (!f || !random) abort();
  random_normals(random, ROWS, f->v);
  random_close(random);
  for (int i = 0; i < ROWS; i++) {
    f->flight[i] = i / EACH;
    f->follows[i] = i % EACH > 0;
    f->lift[i] = 1.0 + 0.5 * sin(0.1 * i);
    f->v[i] += own[i / EACH] * (lifts ? f->lift[i] : 1.0);
  }
  f->r = (rows_t){.n = ROWS, .flight = f->flight, .follows = f->follows, .lift = lifts ? f->lift : NULL};
  return f;
}

static const struct {
  double own[FLIGHTS], between; // its sd between flights
  bool lifts;
} FLOWN[] = {{{0.0, 0.0, 0.0}, 0.0, false},
             {{2.0, 2.0, 2.0}, 0.0, false}, // of all: they do not differ
             {{3.0, -1.0, 1.0}, 2.0, false},
             {{3.0, -1.0, 1.0}, 2.0, true}};

TEST(gap_finds_by_how_much_flights_differ) {
  double room[ROWS];
  for (unsigned i = 0; i < sizeof FLOWN / sizeof *FLOWN; i++) {
    ROW("%g %g %g", FLOWN[i].own[0], FLOWN[i].own[1], FLOWN[i].own[2]);
    flights_t *const f = flights_of(FLOWN[i].own, FLOWN[i].lifts);
    const color_t white = {.sd = 1.0, .used = true};
    // A flight's constant is known to 0.05.
    CHECK_NEAR(color_between(&white, &f->r, f->v, room), FLOWN[i].between, 0.1);
    free(f);
  }
}

// The white rows of a constant hold of it what flights of this spread do, and no more.
TEST(gap_holds_a_constant_by_flights_where_these_differ) {
  static const double none[FLIGHTS] = {0.0};
  const color_t color = {.a1 = 0.5, .a2 = -0.2, .sd = 1.0, .used = true, .between = 2.0};
  color_t alike = color;
  alike.between = 0.0;
  for (int lifts = 0; lifts < 2; lifts++) {
    double one[ROWS], out[ROWS], left = 0.0, holds = 0.0, of_flight[FLIGHTS] = {0.0}, held = 0.0;
    flights_t *const f = flights_of(none, lifts);
    for (int i = 0; i < ROWS; i++) one[i] = rows_lift(&f->r, i);
    color_whiten(&alike, &f->r, one, out);
    for (int i = 0; i < ROWS; i++) of_flight[i / EACH] += out[i] * out[i];
    for (int k = 0; k < FLIGHTS; k++) held += 1.0 / (color.between * color.between + 1.0 / of_flight[k]);
    color_whiten(&color, &f->r, one, out);
    for (int i = 0; i < ROWS; i++) holds += out[i] * out[i];
    CHECK_NEAR(holds, held, 1e-9);
    color_whiten(&color, &f->r, f->v, out);
    for (int i = 0; i < ROWS; i++) left += out[i] * out[i];
    CHECK_NEAR(color_left(&f->r, &color, f->v), left, 1e-9 * left);
    free(f);
  }
}

TEST(gap_takes_out_of_rows_what_flights_have_for_their_own) {
  double room[ROWS];
  const color_t white = {.sd = 1.0, .used = true};
  for (unsigned i = 0; i < sizeof FLOWN / sizeof *FLOWN; i++) {
    ROW("%g %g %g", FLOWN[i].own[0], FLOWN[i].own[1], FLOWN[i].own[2]);
    flights_t *const f = flights_of(FLOWN[i].own, FLOWN[i].lifts);
    const double mean = (FLOWN[i].own[0] + FLOWN[i].own[1] + FLOWN[i].own[2]) / FLIGHTS;
    for (int k = 0; k < FLIGHTS; k++) CHECK_NEAR(rows_constant(&f->r, f->v, k), FLOWN[i].own[k], 0.15);
    CHECK_NEAR(rows_usual(&f->r, f->v, FLIGHTS), mean, 0.1);
    rows_take(&f->r, f->v, 1, 5.0);
    CHECK_NEAR(rows_constant(&f->r, f->v, 1), FLOWN[i].own[1] - 5.0, 0.15);
    CHECK_NEAR(rows_constant(&f->r, f->v, 2), FLOWN[i].own[2], 0.15);
    rows_take(&f->r, f->v, 1, -5.0);
    rows_level(&f->r, f->v);
    CHECK_NEAR(color_between(&white, &f->r, f->v, room), 0.0, 1e-9);
    CHECK_NEAR(color_differ(&white, &f->r, f->v).mean, mean, 0.1);
    rows_center(&f->r, f->v);
    CHECK_NEAR(color_differ(&white, &f->r, f->v).mean, 0.0, 0.01); // two rows of each have none before them
    double squares = 0.0;
    for (int k = 0; k < ROWS; k++) squares += f->v[k] * f->v[k];
    CHECK_NEAR(squares / ROWS, 1.0, 0.1); // noise alone
    free(f);
  }
}

// What is there for a third of the time stays, and of all else nothing is left but noise.
TEST(gap_clears_rows_of_what_a_flight_has_all_the_time) {
  double room[ROWS];
  for (int lifts = 0; lifts < 2; lifts++) {
    ROW("%s", lifts ? "times the lift" : "plain");
    flights_t *const f = flights_of((const double[FLIGHTS]){0.0, 20.0, -5.0}, lifts);
    for (int i = 0; i < ROWS; i++) f->lift[i] = 1.0 + 0.5 * sin(0.1 * i);
    f->r.lift = f->lift;
    for (int i = 0; i < ROWS; i++) f->v[i] += i % 3 == 0 ? 30.0 : 0.0;
    rows_clear(&f->r, f->v, room);
    double rest = 0.0, third = 0.0;
    for (int i = 0; i < ROWS; i++) *(i % 3 ? &rest : &third) += f->v[i] / (i % 3 ? ROWS * 2 / 3 : ROWS / 3);
    CHECK_NEAR(rest, -0.7, 0.3); // the median of noise, a third of which is large
    CHECK_NEAR(third - rest, 30.0, 0.3);
    free(f);
  }
}

// Two flights of 600 rows each, in which the size is another, by so much of what is typical: what they have
// in common is known no better than that. It is told to 0.05 by their blocks.
TEST(gap_errors_grow_where_flights_contradict_each_other) {
  static const struct {
    double apart, least, most;
  } row[] = {{0.0, 0.03, 0.10}, {1.0, 0.35, 0.70}, {4.0, 1.6, 2.4}};
  const choice_t none = {.n = 0};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    why_t why = {""};
    ROW("apart by %g", row[i].apart);
    gap_rows_make(&g, 7);
    const int drag = gap_rows_candidate(&g, "rotor_drag");
    double *const x = gap_rows_column(&g, drag, 0, CH_FX), typical = g.candidate[drag].typical[0];
    gap_rows_white(&g, x);
    for (int k = 0; k < GAP_ROWS; k++) x[k] *= 20.0 / sqrt(GAP_ROWS); // a typical one has 20 standard errors
    gap_rows_add(&g, drag, 0, 1.5);
    for (int k = 0; k < GAP_ROWS; k++)
      g.residual[CH_FX][k] += (k < GAP_ROWS / 2 ? -0.5 : 0.5) * row[i].apart * x[k];
    gap_rows_open(&g, 0, NULL);
    const choice_t with = choice_with(&none, drag);
    const double alone = score_last(&g.round.score, &with).stderr_[0] / typical;
    g.round.gram.n_flight = 2;
    const double told = score_last(&g.round.score, &with).stderr_[0] / typical;
    CHECK(told >= alone && told > row[i].least && told < row[i].most);
    CHECK(row[i].apart == 0.0 || told > 3.0 * alone); // blocks, each by itself, say it of one flight
    evidence_t e;
    CHECK_OK(evidence_make(&e, &g.round, &why));
    CHECK((evidence_of(&e, &g.candidates, 1, &drag) > 0.9) == (row[i].apart == 0.0));
    evidence_free(&e);
    gap_rows_free(&g);
  }
}
