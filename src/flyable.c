// flyable.c - whether accelerometer, gyro and attitude agree.
#include "flight/flyable.h"

#include "flight/bounds.h"

// Constants: the name ends in the unit, if there is one. The comment behind gives the reason for the value,
// and the line above each group names the test that pins it.

// test: a_wrong_up_is_told_after_so_long_and_taken_back_at_once
#define STEP_S      0.001f // of a call
#define STILL_RADPS 0.1f   // a hand at rest turns more slowly
#define STILL_S     0.2f   // the hand's motion has died away
#define WRONG_S     0.3f   // a jolt is shorter
#define UP_MPS2     4.0f   // 24 degrees, or 0.4 g
// test: a_vehicle_on_its_side_is_not_flyable_though_its_estimate_agrees
#define UPRIGHT_MPS2 (0.5f * GRAVITY_MPS2) // along z; with less it cannot take off
// test: a_turn_tells_of_a_wrong_axis_from_so_much_on
#define STRETCH_MS 100   // long against the sensors' noise, short against the estimate's drift
#define ENOUGH     2.0f  // (m/s2)^2, half that of a turn by 12 degrees in one stretch
#define JOLT_MPS2  3.0f  // of the specific force's size against g
#define EXPLAINED  0.4f  // k below this is a contradiction
#define FORGET     0.98f // per stretch; jolts of the hand do not count for ever
// test: a_stretch_that_hardly_turned_adds_nothing
#define TURNED_MPS2 0.5f // a smaller turn says less than the jolts of a hand
// test: what_is_no_number_says_nothing_about_being_flyable
#define RATE_MOST_RADPS 100.0f // three times the gyro's range

void flyable_init(flyable_t *s) {
  *s = (flyable_t){.not_flyable = 0};
}

static bool up(flyable_t *s, v3_t acc, v3_t rate, quat_t q) {
  const bool kept = (s->not_flyable & FLYABLE_UP) != 0;
  s->steady_s = EITHER(v3_within(rate, STILL_RADPS), f_clamp(s->steady_s + STEP_S, 0.0f, 1.0f), 0.0f);
  const bool still = !(s->steady_s < STILL_S);
  if (!ANY(still)) return kept;
  const v3_t wanted = quat_to_body(quat_unit(q), (v3_t){0.0f, 0.0f, GRAVITY_MPS2});
  const v3_t error = v3_sub(acc, wanted);
  // On its back on a table the estimate may agree, but the vehicle cannot take off from there either.
  const bool wrong = v3_dot(error, error) > UP_MPS2 * UP_MPS2 || acc.z < UPRIGHT_MPS2;
  const float wrong_s = EITHER(wrong, f_clamp(s->wrong_s + STEP_S, 0.0f, WRONG_S), 0.0f);
  s->wrong_s = EITHER(still, wrong_s, s->wrong_s);
  return EITHER(still, wrong && (kept || s->wrong_s >= WRONG_S), kept);
}

// True if the turn so far contradicts the gyro along one axis; `kept` if it says nothing.
static bool turn(flyable_turn_t *s, bool kept, float change, float explained) {
  const bool turned = !(fabsf(explained) < TURNED_MPS2);
  FOR_WHOM(turned, s) {
    s->cross = FORGET * s->cross + change * explained;
    s->square = FORGET * s->square + explained * explained;
  }
  return EITHER(turned && !(s->square < ENOUGH), s->cross < EXPLAINED * s->square, kept);
}

static bool jolted(v3_t acc) {
  return !(fabsf(sqrtf(v3_dot(acc, acc)) - GRAVITY_MPS2) <= JOLT_MPS2);
}

static void stands(flyable_t *s, unsigned reason, bool does) {
  s->not_flyable = EITHER(does, s->not_flyable | reason, s->not_flyable & ~reason);
}

static void end_stretch(flyable_t *s, v3_t acc) {
  s->stretch_ms = 0;
  FOR_WHOM(!jolted(acc) && !jolted(s->acc_from), s) {
    const v3_t change = v3_sub(acc, s->acc_from);
    const bool was_x = (s->not_flyable & FLYABLE_TURN_X) != 0, was_y = (s->not_flyable & FLYABLE_TURN_Y) != 0;
    stands(s, FLYABLE_TURN_X, turn(&s->turn_x, was_x, change.x, s->explained.x));
    stands(s, FLYABLE_TURN_Y, turn(&s->turn_y, was_y, change.y, s->explained.y));
  }
}

void flyable_step(flyable_t *s, v3_t acc, v3_t rate, quat_t q) {
  if (!v3_within(acc, BOUND_ACC_MPS2) || !v3_within(rate, RATE_MOST_RADPS) || !quat_plausible(q)) return;
  stands(s, FLYABLE_UP, up(s, acc, rate, q));
  FOR_WHOM(s->stretch_ms == 0, s) {
    s->acc_from = acc;
    s->explained = (v3_t){0.0f, 0.0f, 0.0f};
  }
  s->explained = v3_sub(s->explained, v3_scale(STEP_S, v3_cross(rate, acc)));
  s->stretch_ms++;
  FOR_WHOM(!(s->stretch_ms < STRETCH_MS), s) end_stretch(s, acc);
}
