// test_status.c - the statuses in words.
#include "flight/status.h"
#include "rig/test.h"

TEST(status_of_every_kind_has_a_name_of_its_own) {
  static const char *const name[] = {
      "ok",          "bad input",         "bad set point", "bad parameter", "bad range sample",
      "height jump", "sample not taught", "singular",      "bad state"};
  CHECK(sizeof name / sizeof *name == ST_COUNT);
  for (unsigned i = 0; i < sizeof name / sizeof *name; i++) CHECK_TEXT(status_name((status_t)i), name[i]);
}

TEST(status_that_is_none_is_said_to_be_unknown) {
  static const int row[] = {ST_COUNT, ST_COUNT + 1, 255, -1};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d", row[i]);
    CHECK_TEXT(status_name((status_t)row[i]), "unknown status");
  }
}
