// flyable.c - do accelerometer and gyro tell of one and the same vehicle?
#include "flight/flyable.h"

#define STEP_S      0.001f
#define STRETCH_MS  100
#define STILL_RADPS 0.1f
#define STILL_S     0.2f
#define WRONG_S     0.3f
#define UP_MPS2     4.0f  // 24 degrees, or 0.4 g
#define ENOUGH      2.0f  // (m/s2)^2, half that of a turn by 12 degrees in one stretch
#define TURNED_MPS2 0.5f  // less of a turn says less than a hand's jolts do
#define JOLT_MPS2   3.0f  // of the specific force's size
#define EXPLAINED   0.4f  // k below this is a contradiction
#define FORGET      0.98f // a stretch; a hand's own jolts are no evidence for ever

void flyable_init(flyable_t *s) {
  *s = (flyable_t){.not_flyable = 0};
}

static void judge_up(flyable_t *s, v3_t acc, v3_t rate, quat_t q) {
  s->steady_s = v3_within(rate, STILL_RADPS) ? f_clamp(s->steady_s + STEP_S, 0.0f, 1.0f) : 0.0f;
  if (s->steady_s < STILL_S) return;
  const v3_t wanted = quat_to_body(quat_unit(q), (v3_t){0.0f, 0.0f, GRAVITY_MPS2});
  const v3_t error = v3_sub(acc, wanted);
  // On its back on a table the estimate may agree: it cannot take off from there either.
  const bool wrong = v3_dot(error, error) > UP_MPS2 * UP_MPS2 || acc.z < 0.5f * GRAVITY_MPS2;
  s->wrong_s = wrong ? f_clamp(s->wrong_s + STEP_S, 0.0f, WRONG_S) : 0.0f;
  if (s->wrong_s >= WRONG_S)
    s->not_flyable |= FLYABLE_UP;
  else if (!wrong)
    s->not_flyable &= ~(unsigned)FLYABLE_UP;
}

// What of `reason` the turn so far says; `now` where it says nothing.
static unsigned judge_turn(flyable_turn_t *s, unsigned now, float change, float explained, unsigned reason) {
  if (fabsf(explained) < TURNED_MPS2) return now;
  s->cross = FORGET * s->cross + change * explained;
  s->square = FORGET * s->square + explained * explained;
  if (s->square < ENOUGH) return now;
  return s->cross < EXPLAINED * s->square ? now | reason : now & ~reason;
}

static bool jolted(v3_t acc) {
  return !(fabsf(sqrtf(v3_dot(acc, acc)) - GRAVITY_MPS2) <= JOLT_MPS2);
}

void flyable_step(flyable_t *s, v3_t acc, v3_t rate, quat_t q) {
  if (!v3_within(acc, 1000.0f) || !v3_within(rate, 100.0f) || !quat_plausible(q)) return;
  judge_up(s, acc, rate, q);
  if (s->stretch_ms == 0) {
    s->acc_from = acc;
    s->explained = (v3_t){0.0f, 0.0f, 0.0f};
  }
  s->explained = v3_sub(s->explained, v3_scale(STEP_S, v3_cross(rate, acc)));
  if (++s->stretch_ms < STRETCH_MS) return;
  s->stretch_ms = 0;
  if (jolted(acc) || jolted(s->acc_from)) return;
  const v3_t change = v3_sub(acc, s->acc_from);
  s->not_flyable = judge_turn(&s->turn_x, s->not_flyable, change.x, s->explained.x, FLYABLE_TURN_X);
  s->not_flyable = judge_turn(&s->turn_y, s->not_flyable, change.y, s->explained.y, FLYABLE_TURN_Y);
}
