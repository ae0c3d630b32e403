// test_nearest.c - did you mean.
#include "base/nearest.h"
#include "rig/test.h"

#include <limits.h>
#include <string.h>

TEST(nearest_counts_slips) {
  static const struct {
    const char *a, *b;
    int slips;
  } row[] = {
      {"", "", 0},
      {"", "abc", 3},
      {"ceiling", "ceiling", 0},
      {"CeilinG", "ceiling", 0},
      {"cieling", "ceiling", 1}, // exchanged
      {"ceilng", "ceiling", 1},  // left out
      {"ceeiling", "ceiling", 1},
      {"cealing", "ceiling", 1}, // changed
      {"ca", "abc", 3},          // restricted: what was exchanged is not changed again
      {"kitten", "sitting", 3},
      {"indiPos.kp", "indiAtt.kp", 3},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s, %s", row[i].a, row[i].b);
    CHECK(nearest_slips(row[i].a, row[i].b) == row[i].slips);
    CHECK(nearest_slips(row[i].b, row[i].a) == row[i].slips);
  }
  char shorter[NEAREST_LETTERS + 1], longer[NEAREST_LETTERS + 2];
  memset(shorter, 'a', sizeof shorter);
  memset(longer, 'a', sizeof longer);
  shorter[NEAREST_LETTERS] = longer[NEAREST_LETTERS + 1] = '\0';
  CHECK(nearest_slips(shorter, shorter) == 0);
  CHECK(nearest_slips(shorter, longer) == INT_MAX);
  CHECK(nearest_slips(longer, longer) == INT_MAX);
}

TEST(nearest_names_what_may_be_meant_and_nothing_else) {
  static const char *const names[] = {"ceiling", "ground", "wind", "mass", "ceiling_rpm", NULL};
  static const struct {
    const char *typed, *hint;
  } row[] = {
      {"cieling", " (did you mean ceiling?)"},
      {"grond", " (did you mean ground?)"},
      {"wnd", " (did you mean wind?)"},
      {"MASS", " (did you mean mass?)"},
      {"ceilng_rmp", " (did you mean ceiling_rpm?)"},
      {"w", ""},  // a letter is no word
      {"wi", ""}, // a third of a word may be wrong
      {"fog", ""},
      {"sealing", " (did you mean ceiling?)"},
      {"", ""},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].typed);
    char hint[NEAREST_HINT];
    CHECK_TEXT(nearest_of(row[i].typed, names, hint), row[i].hint);
  }
}
