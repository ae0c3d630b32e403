// test_exam.c - the hidden-effect exam on a few sets: names, alarms and unknowns.
#include "exam/exam.h"
#include "test.h"

#define FIRST_SEED 90001u // never those of `make exam`
#define SETS       12
#define SETS_LONG  30

typedef struct {
  int large, exact, nothing, alarms, strange, wrong, flown;
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
}

static marks_t sit(int sets) {
  marks_t m = {0};
  for (int i = 0; i < sets; i++) {
    exam_set_t set;
    why_t why;
    if (exam_one(exam_kind(i), FIRST_SEED + (unsigned)i, &set, &why) == ST_OK) add(&m, &set);
  }
  return m;
}

TEST(the_workflow_names_what_an_exam_hides_and_nothing_else) {
  const int sets = test_long() ? SETS_LONG : SETS;
  const marks_t m = sit(sets);
  CHECK(m.flown == sets);
  CHECK(m.large >= 1);
  CHECK(m.exact >= 0.8 * m.large); // of few: the goal of 95 % is for hundreds
  CHECK(m.alarms <= 0.1 * m.nothing);
  CHECK(m.strange >= 1 && m.wrong <= 1 + m.strange / 5); // one in five on average: README.md
}
