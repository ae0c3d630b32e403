// test_reliability.c - the probability stated with names against the share that is right, on invented
// verdicts.
#define _POSIX_C_SOURCE 200809L // fmemopen
#include "exam/users.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

#define EFFECT(name, p) "{\"name\": \"" name "\", \"rivals\": [\"thrust_scale\"], \"probability\": " p "}"

TEST(names_stand_in_the_bin_of_what_was_stated) {
  static const struct {
    const char *hidden, *effects;
    int bin, of, right, unstated;
  } row[] = {
      {"mass", EFFECT("mass", "1"), 3, 1, 1, 0},
      {"mass", EFFECT("mass", "0.95"), 3, 1, 1, 0},
      {"mass", EFFECT("mass", "0.9499"), 2, 1, 1, 0},
      {"mass", EFFECT("mass", "0.8"), 2, 1, 1, 0},
      {"mass", EFFECT("mass", "0.5"), 1, 1, 1, 0},
      {"mass", EFFECT("mass", "0"), 0, 1, 1, 0},
      {"mass", EFFECT("mass", "null"), 3, 0, 0, 1}, // no probability stated
      {"mass", EFFECT("wind", "0.97"), 3, 1, 0, 0},
      {"thrust_scale", EFFECT("mass", "0.97"), 3, 1, 1, 0}, // hidden is a rival that is told
      {"mass", EFFECT("wind", "0.99") "," EFFECT("mass", "0.99"), 3, 2, 1, 0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].effects);
    char text[400];
    snprintf(text, sizeof text, "{\"verdict\": \"named\", \"effects\": [%s], \"unknown\": null}",
             row[i].effects);
    users_set_t set = {.n = 1, .hidden = {row[i].hidden}};
    cJSON *const verdict = cJSON_Parse(text);
    CHECK(verdict);
    users_mark(&set, verdict);
    CHECK(set.stated.bin[row[i].bin].of == row[i].of && set.stated.bin[row[i].bin].right == row[i].right);
    CHECK(set.stated.unstated == row[i].unstated);
    int all = 0;
    for (int k = 0; k < RELIABILITY_BINS; k++) all += set.stated.bin[k].of;
    CHECK(all == row[i].of);
    cJSON_Delete(verdict);
  }
}

// Each end of the interval lies 1.645 of its own standard deviations away from the observed share.
TEST(a_share_has_the_interval_of_wilson) {
  static const struct { int right, of; } row[] = {{3, 10}, {1, 2}, {95, 100}, {0, 10}, {10, 10}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d/%d", row[i].right, row[i].of);
    const double share = (double)row[i].right / row[i].of;
    double end[2];
    reliability_interval(row[i].right, row[i].of, &end[0], &end[1]);
    CHECK(end[0] <= share && share <= end[1] && end[1] - end[0] > 0.01);
    for (int k = 0; k < 2; k++) {
      const double sd = sqrt(end[k] * (1.0 - end[k]) / row[i].of);
      CHECK_NEAR(fabs(share - end[k]), 1.6449 * sd, 1e-4);
    }
  }
}

// The same as for flights of another simulator (test/outside/test_marks.py).
TEST(the_reliability_diagram_is_a_line_for_each_bin) {
  static const struct {
    double stated;
    bool right;
  } name[] = {{1.0, true},  {0.95, true}, {0.99, false},       {0.97, true},        {0.9499, true},
              {0.8, false}, {0.0, false}, {(double)NAN, true}, {(double)NAN, false}};
  reliability_t half[2] = {{.unstated = 0}, {.unstated = 0}};
  for (unsigned i = 0; i < sizeof name / sizeof *name; i++)
    reliability_add(&half[i % 2], name[i].stated, name[i].right);
  reliability_join(&half[0], &half[1]);
  char text[1000] = "";
  FILE *const out = fmemopen(text, sizeof text, "w");
  reliability_print(&half[0], out);
  fclose(out);
  CHECK_TEXT(text, "  stated           mean       right            90 % interval\n"
                   "  0    to 0.5      0.000    0/1      0.0 %     0.0 to  73.0 %\n"
                   "  0.5  to 0.8          -    0/0\n"
                   "  0.8  to 0.95     0.875    1/2     50.0 %    12.1 to  87.9 %\n"
                   "  0.95 to 1        0.978    3/4     75.0 %    35.6 to  94.2 %\n"
                   "  names without a probability: 2\n");
}
