// test_gap_standing.c - how sure a name is told.
#include "gap/8_report/report.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

// One that held-out flights spoke against was told as strong.
TEST(gap_tells_no_name_as_strong_that_held_out_flights_speak_against) {
  static const struct {
    const char *what;
    double left_after, floor; // of 1
    double held_share;        // of the name
    int rivals;
    double probability;
    standing_t standing;
  } cases[] = {{"explained better", 0.9, 0.04, 1.0, 0, 0.99, STANDS_STRONG},
               {"no better", 1.0, 0.04, 1.0, 0, 0.99, STANDS_LIKELY},
               {"better, and more than noise is left", 0.9, 0.01, 1.0, 0, 0.99, STANDS_LIKELY},
               {"better, and another name would do", 0.9, 0.04, 1.0, 1, 0.99, STANDS_AMBIGUOUS},
               {"better, and as improbable as not", 0.9, 0.04, 1.0, 0, 0.94, STANDS_LIKELY},
               {"better, and nobody knows how probable", 0.9, 0.04, 1.0, 0, (double)NAN, STANDS_STRONG},
               {"better, not by this name", 0.9, 0.04, 0.49, 0, 0.99, STANDS_LIKELY},
               {"better, a little by this name", 0.9, 0.04, 0.51, 0, 0.99, STANDS_STRONG},
               {"better, and nothing judges the name", 0.9, 0.04, (double)NAN, 0, 0.99, STANDS_STRONG}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%s", cases[i].what);
    study_t *const study = calloc(1, sizeof *study);
    report_t *const r = calloc(1, sizeof *r);
    diagnosis_t *const d = &study->diagnosis;
    named_t named = {
        .n_rival = cases[i].rivals, .held_share = cases[i].held_share, .probability = cases[i].probability};
    const finding_t finding = {.named = &named, .profile = {.channel = CH_FZ}};
    r->study = study;
    d->nominal_flew = true;
    d->found.n = 1;
    d->held_out.left_before = 1.0;
    d->held_out.left_after = cases[i].left_after;
    d->held_out.channel[CH_FZ] = (gap_part_t){.used = true, .after = 0.05, .floor = cases[i].floor};
    CHECK(report_standing(r, &finding) == cases[i].standing);
    free(study);
    free(r);
  }
}
