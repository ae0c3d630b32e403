// test_status.c - the statuses in words.
#include "flight/status.h"
#include "test.h"

TEST(status_of_every_kind_has_a_name_of_its_own) {
  static const char *const name[ST_COUNT] = {
      "ok",          "bad input",         "bad set point", "bad parameter", "bad range sample",
      "height jump", "sample not taught", "singular"};
  for (int i = 0; i < ST_COUNT; i++) CHECK_TEXT(status_name((status_t)i), name[i]);
}

TEST(status_that_is_none_is_said_to_be_unknown) {
  static const int row[] = {ST_COUNT, ST_COUNT + 1, 255, -1};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d", row[i]);
    CHECK_TEXT(status_name((status_t)row[i]), "unknown status");
  }
}
