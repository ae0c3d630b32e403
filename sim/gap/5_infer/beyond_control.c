// beyond_control.c - the size, and the share of the residual, that control can mimic.
#include "gap/5_infer/beyond_control.h"

#include <math.h>

// Control answers a disturbance d with commands -T d, beside what the pilot commands, and the residual is d.
// A slope q of the residual on the commands explains at most the share q |T| of its squares: the more the
// pilot commands, the flatter the slope and the smaller the share. CONTROL_PEAK is the largest peak of |T|
// that loops are designed for, so control explains no more than this times q. A real inertia explains all but
// noise.
#define CONTROL_PEAK 2.0

// The slope is the number itself for a candidate that is not chosen (a line about 0), and k / (1 + k) for a
// chosen inertia J (1 + k). The explained share is that of all channels, smaller than that of the turning
// alone.
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

// For an effect that control can mimic: it explains too much, or no number surely has the sign that control
// makes and at least one surely has the other. For any other effect: always.
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
