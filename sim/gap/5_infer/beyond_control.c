// beyond_control.c - the size, and the share, of what control makes.
#include "gap/5_infer/beyond_control.h"

#include <math.h>

// Of a disturbance d control commands -T d, beside what a pilot commands. What of the residual, which is d,
// goes along with the commands at a slope q is q |T| at most of its squares: the more a pilot commands, the
// flatter the slope and the smaller the share. So much more than its slope no control explains, nor one that
// overshoots by the largest peak of T that loops are designed for; an inertia that is there explains all but
// noise.
#define CONTROL_PEAK 2.0

// The slope: of a number that is not chosen the straight line about none, which is it; of an inertia that is
// chosen, J (1 + k), k / (1 + k). Of all channels together the share is smaller than of the turning.
static bool explains_more_than_control(const round_t *r, const choice_t *choice, const verdict_t *v,
                                       bool chosen) {
  const fx_t *const fx = round_fx(r, choice->of[choice->n - 1]);
  choice_t rest = *choice;
  double slope = 0.0;
  rest.n--;
  for (int k = 0; k < fx->n_size; k++) {
    const double made = fx->control_makes * v->value[k];
    slope = fmax(slope, chosen && fx->scales == FX_SCALES_INERTIA ? made / (1.0 + made) : made);
  }
  if (candidates_slow(r->s) || !(slope > 0.0)) return false;
  const double before = score_left(&r->score, &rest, NULL), after = score_left(&r->score, choice, NULL);
  return before - after > CONTROL_PEAK * slope * before;
}

// Of an effect that control's work can look like: no number is surely one that control makes, and one at
// least surely is not; or it explains too much. Of any other effect: always.
bool beyond_control(const round_t *r, const choice_t *choice, const verdict_t *v, bool chosen) {
  const fx_t *const fx = round_fx(r, choice->of[choice->n - 1]);
  if (fx->control_makes == 0 || (r->nominal && r->nominal->n)) return true;
  if (explains_more_than_control(r, choice, v, chosen)) return true;
  bool beyond = false;
  for (int k = 0; k < fx->n_size; k++) {
    const double made = fx->control_makes * v->value[k], error = SCORE_ERRORS * v->stderr_[k];
    if (made > error) return false;
    beyond = beyond || made < -error;
  }
  return beyond;
}
