// lesson.h - training data for the learner in tests: samples of a ceiling, hovers of any length, and the
// properties that must hold after each.
#ifndef TEST_RIG_LESSON_H
#define TEST_RIG_LESSON_H

#include "flight/rls.h"
#include <stdbool.h>
#include <stdint.h>

extern const rbf_weights_t lesson_flat; // no ceiling effect at all
extern const rls_param_t lesson_thesis, lesson_walk;

double lesson_theory(double z_m); // 1 + 0.44 exp(-80 z)

// A sample of the ceiling at z: basis functions and measured ratio.
typedef struct {
  float a[RBF_N], y;
} lesson_t;

lesson_t lesson_at(double z_m, double y);

typedef struct {
  int first_bad; // the first sample after which something was not finite; -1: never
  bool symmetric;
  double eigen_min, eigen_max, w_max; // extremes over the whole run
} lesson_run_t;

enum { LESSON_MINUTE = 6000 }; // samples

typedef status_t lesson_update_fn(rls_t *, const rls_param_t *, const float *, float);

// Learns in a hover at z with 2 % noise on the ratio and 2 mm of motion, from `gain` times the theory;
// watches the state.
lesson_run_t lesson_hover_by(rls_t *s, lesson_update_fn *update, const rls_param_t *p, double z_m,
                             double gain, int samples, uint64_t seed);
// The same with the flight code's update.
lesson_run_t lesson_hover(rls_t *s, const rls_param_t *p, double z_m, double gain, int samples,
                          uint64_t seed);

// Adds the state's extremes to those of the run.
void lesson_watch(lesson_run_t *run, const rls_t *s);
bool lesson_all_finite(const rls_t *s);

// True if the run shows what every form that may fly must show.
bool lesson_keeps_its_properties(const lesson_run_t *run, const rls_param_t *p);

double lesson_curve(const rls_t *s, double z_m); // the ratio that was learned

#endif
