// test_exam.c - the hidden-effect exam on a few sets: names, alarms and unknowns.
#include "exam/exam.h"
#include "rig/share.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

#define FIRST_SEED 90001u // never those of `make exam`
#define SETS       18
#define SETS_LONG  72

// The sets among the first SETS that the short form marks: large effects, forces outside the library, nothing
// hidden. (Hovers are the next test's.) The long form has all sets and more, and checks each kind; so does
// SEED=N, with sets that nobody has seen.
static const int FEW[] = {3, 9, 15, 2, 4, 7, 1};

// More sets outside the library than `make exam` has, because one or two of a kind could not break a bound.
static exam_kind_t kind_of(int i) {
  static const exam_kind_t order[] = {EXAM_ONE,     EXAM_NOTHING, EXAM_STRANGE, EXAM_ONE, EXAM_STRANGE,
                                      EXAM_HOVER,   EXAM_ONE,     EXAM_STRANGE, EXAM_ONE, EXAM_ONE,
                                      EXAM_NOTHING, EXAM_STRANGE, EXAM_HOVER,   EXAM_ONE, EXAM_NOTHING,
                                      EXAM_ONE,     EXAM_HOVER,   EXAM_TWO};
  return order[i % (int)(sizeof order / sizeof *order)];
}

typedef struct {
  int large, exact, nothing, alarms, strange, wrong, hover, guessed, flown;
} marks_t;

static void add(marks_t *m, const exam_set_t *s) {
  m->flown += s->flew;
  if (s->kind == EXAM_ONE && s->times[0] >= 1.0) {
    m->large++;
    m->exact += s->exact;
  }
  if (s->kind == EXAM_NOTHING) {
    m->nothing++;
    m->alarms += s->wrong > 0;
  }
  if (s->kind == EXAM_STRANGE) {
    m->strange++;
    m->wrong += s->wrong > 0;
  }
  if (s->kind == EXAM_HOVER) {
    m->hover++;
    m->guessed += s->wrong > 0;
  }
}

static marks_t sit(int sets, const int few[]) {
  marks_t m = {0};
  for (int k = 0; k < sets; k++) {
    const int i = few ? few[k] : k;
    exam_set_t set;
    why_t why;
    if (exam_one(kind_of(i), share_seed(FIRST_SEED) + (unsigned)i, &set, &why) == DONE) add(&m, &set);
  }
  return m;
}

TEST(the_workflow_names_what_an_exam_hides_and_nothing_else) {
  const bool few = !test_long() && share_seed(FIRST_SEED) == FIRST_SEED;
  const int sets = test_long() ? SETS_LONG : few ? (int)(sizeof FEW / sizeof *FEW) : SETS;
  const marks_t m = sit(sets, few ? FEW : NULL);
  CHECK(m.flown == sets);
  CHECK(m.large >= 1 && m.nothing >= 1 && m.strange >= 3 && (few || m.hover >= 1));
  CHECK_SHARE(m.exact, m.large, 0.9);
  if (!few) CHECK_SHARE(m.nothing - m.alarms, m.nothing, 0.95);
  CHECK_SHARE(m.strange - m.wrong, m.strange, 0.95);
  if (!few) CHECK_SHARE(m.hover - m.guessed, m.hover, 0.95);
  const int wrong = m.large - m.exact + m.alarms + m.wrong + m.guessed;
  const int marked = m.large + m.nothing + m.strange + m.hover;
  CHECK_SHARE(marked - wrong, marked, 0.95); // few sets of a kind detect little, all together more
}

// The smallest visible size that was told was once too small in each: a slowly decaying curve shows in any
// hover.
TEST(what_a_hover_hides_is_not_promised_to_be_seen) {
  static const struct {
    const char *what;
    unsigned long seed;
    double least, most; // smallest visible size told, over typical
  } row[] = {
      {"tof_latency", 52070, 2.03, 8.0}, // 2.03 times typical was hidden, and not named
      {"ceiling", 52143, 1e3, HUGE_VAL},
      {"ground", 52047, 1e3, HUGE_VAL},
      {"motor_damage", 52012, 0.12, 0.31}, // named: a hover shows it well, and says so
  };
  for (unsigned i = 0; i < FEW_OR_ALL(row, 2); i++) {
    ROW("%s of set %lu", row[i].what, row[i].seed);
    exam_set_t set;
    why_t why;
    CHECK_OK(exam_one(EXAM_HOVER, row[i].seed, &set, &why));
    CHECK_TEXT(set.hidden[0], row[i].what);
    CHECK(set.wrong == 0 && set.least[0] >= row[i].least && set.least[0] <= row[i].most);
    CHECK(set.found == 1 || set.says_not_testable);
  }
}

// Velocities of 2 cm/s have errors of 3 cm/s. The part of the moment that least squares did not find was
// taken for noise, and flapping of 3.3 times its typical size was missed or found at a tenth of its size. Set
// 24156 is told as rotor_drag: its moments stir little in the quieter half of that hover.
TEST(large_flapping_is_named_in_a_hover_and_its_size_is_right) {
  static const unsigned long seed[] = {24026, 24256, 24269, 24086, 52076};
  for (unsigned i = 0; i < FEW_OR_ALL(seed, 1); i++) {
    ROW("set %lu", seed[i]);
    exam_set_t set;
    why_t why;
    CHECK_OK(exam_one(EXAM_HOVER, seed[i], &set, &why));
    CHECK_TEXT(set.hidden[0], "flapping");
    CHECK(set.exact);
    for (int k = 0; k < set.n_value; k++)
      CHECK_NEAR(set.value[k].value, set.value[k].truth, 0.1 * set.value[k].truth);
  }
}

// The ground effect is computed from heights with errors of 8 mm.
TEST(numbers_hold_that_are_multiplied_by_the_logs_errors) {
  static const struct {
    const char *what;
    exam_kind_t kind;
    unsigned long seed;
  } row[] = {
      {"ground", EXAM_TWO, 52092},
      {"ground", EXAM_TWO, 126010},
      {"ground", EXAM_TWO, 126130},
  };
  for (unsigned i = 0; i < FEW_OR_ALL(row, 1); i++) {
    ROW("%s of set %lu", row[i].what, row[i].seed);
    exam_set_t set;
    why_t why;
    int named = 0;
    CHECK_OK(exam_one(row[i].kind, row[i].seed, &set, &why));
    for (int k = 0; k < set.n_value; k++) {
      const exam_value_t *const v = &set.value[k];
      if (strcmp(v->name, row[i].what) != 0) continue;
      named++;
      CHECK(exam_holds(v));
      CHECK(fabs(v->value - v->truth) < 0.35 * v->truth); // these errors took a tenth to a half of it
    }
    CHECK(named == 1);
  }
}

static void named_alone(exam_kind_t kind, unsigned long seed) {
  exam_set_t set;
  why_t why;
  ROW("set %lu", seed);
  CHECK_OK(exam_one(kind, seed, &set, &why));
  CHECK(set.exact && set.n > 0);
}

// The sag's voltage lies between those that are tried. The other effect is chosen before it is refined, and a
// scale or slope made up for what the wrong voltage leaves.
TEST(a_sag_beside_another_effect_has_its_own_voltage) {
  static const unsigned long seed[] = {53233, 29843, 40033};
  for (unsigned i = 0; i < FEW_OR_ALL(seed, 1); i++) named_alone(EXAM_TWO, seed[i]);
}

// The decay lies more than half way to the next one tried, and is found once the scale is chosen.
TEST(a_ground_beside_another_effect_has_its_own_decay) {
  named_alone(EXAM_TWO, 45101);
}

// Between the decays that are tried. Sized by the columns of the nearest of these, it was told as an inverse
// square.
TEST(a_ground_beside_a_ceiling_is_told_in_its_own_form) {
  exam_set_t set;
  why_t why;
  int grounds = 0;
  CHECK_OK(exam_one(EXAM_TWO, 57104, &set, &why));
  CHECK(set.exact);
  for (int k = 0; k < set.n_value; k++)
    grounds += strcmp(set.value[k].name, "ground") == 0 && exam_holds(&set.value[k]);
  CHECK(grounds == 1);
}

// The scale adds what the sag takes away: neither alone is sure, and a bias of the accelerometer was named,
// with a difference of the flights that no name filled.
TEST(a_sag_is_told_beside_a_scale_that_hides_it) {
  named_alone(EXAM_TWO, 62039);
}

// The sensor reads 7 cm too little, but never below 4 cm: that is no floor of 6 or 8 cm.
TEST(a_range_bias_is_told_alone_where_the_sensor_is_at_its_floor) {
  static const unsigned long seed[] = {175106, 175166};
  for (unsigned i = 0; i < FEW_OR_ALL(seed, 1); i++) named_alone(EXAM_ONE, seed[i]);
}

TEST(a_held_out_flight_without_rows_is_left_out_of_the_shrink) {
  static const struct {
    double before, after, oracle;
    bool known;
    double share, best;
  } row[] = {
      {200.0, 50.0, 40.0, true, 0.25, 0.2},
      {200.0, 200.0, 200.0, true, 1.0, 1.0},
      {0.0, 0.0, 0.0, false, 0.0, 0.0},    // no rows are left of the flight
      {200.0, 50.0, 0.0, false, 0.0, 0.0}, // the truth has no rows
      {200.0, 50.0, (double)NAN, false, 0.0, 0.0},
      {200.0, (double)INFINITY, 40.0, false, 0.0, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    double after = row[i].after, oracle = row[i].oracle;
    CHECK(exam_shrink(row[i].before, &after, &oracle) == row[i].known);
    CHECK(after == row[i].share && oracle == row[i].best);
  }
}
