// controller.c - controllerOutOfTree(): the firmware's call every millisecond, around flight_step().
//
// The firmware calls it always, also unarmed and on the ground, with a set point of zeros. It is selected by
// stabilizer.controller = 6, also in flight. *control still holds the command of a millisecond ago, whoever
// gave it, so that taking over causes no bump.
#include "controller.h"

#include "battery_cap.h"
#include "controller_pid.h"
#include "glue.h"
#include "range.h"
#include "recorder.h"
#include "settings.h"
#include "supervisor.h"
#include "units.h"

#define HAND_OVER_MS    1000.0f // from this controller to the stock one and back
#define DOWN_SAME_POLLS 2       // more than the downward sensor's period

void controllerOutOfTreeInit(void) {
  settings_start();
  GLUE.range = (range_up_t){.started = false};
  GLUE.not_flown = 0;
  GLUE.recorder = (recording_t){.calls = 0};
  GLUE.stock_share = GLUE.shadow ? 1.0f : 0.0f;
  flyable_init(&GLUE.flyable);
  controllerPidInit();
}

bool controllerOutOfTreeTest(void) {
  return flight_init(&GLUE.flight, &GLUE.flown) == ST_OK;
}

// Reads the downward range, once in ten calls: the sensor measures forty times a second, without time stamps.
// An unchanged value counts as a new sample each time that it has stood for longer than that.
static void take_down(flight_in_t *in) {
  const float mm = rangeGet(rangeDown);
  const bool same = mm == GLUE.down_mm && GLUE.down_same < DOWN_SAME_POLLS;
  in->down_m = same ? 0.0f : 0.001f * mm;
  GLUE.down_same = (uint8_t)EITHER(same, GLUE.down_same + 1, 0);
  GLUE.down_mm = mm;
}

static void take_range(flight_in_t *in, uint32_t step) {
  // Millimetres, whatever the firmware's header says.
  const range_up_sample_t sample = range_up_poll(&GLUE.range, rangeGet(rangeUp), step);
  in->range_new = sample.is_new;
  if (!ANY(sample.is_new)) return;
  in->range_m = EITHER(sample.is_new, sample.range_m, in->range_m);
  in->range_age_s = EITHER(sample.is_new, sample.age_s, in->range_age_s);
}

// Takes inputs that only the height filter, or a person, reads: in the call of ten in which that filter steps
// and no loop runs.
static void take_rarely(flight_in_t *in, const setpoint_t *setpoint) {
  GLUE.not_flown |= (uint8_t)units_not_flown(setpoint);
  if (GLUE.flown.height.own != 0)
    take_down(in);
  else
    in->down_m = 0.0f;
}

// True if the set point is a pilot's. While the vehicle may not fly it is the supervisor's, which must not
// end a hand-over: a vehicle that was handed over, fell and was armed anew would take off again under a
// client that still sends. In the first call in which it may fly again, the set point is still the old one.
static bool is_pilots(void) {
  const bool could_fly = GLUE.could_fly;
  GLUE.could_fly = supervisorCanFly();
  return (could_fly && GLUE.could_fly) || GLUE.flight.guard.action != GUARD_HAND_OVER;
}

static APART void take_inputs(const control_t *control, const setpoint_t *setpoint,
                              const sensorData_t *sensors, const state_t *state, uint32_t step) {
  flight_in_t *const in = &GLUE.in;
  in->step = step;
  units_sensors(in, sensors, state);
  units_applied(in->force_N, control);
  battery_cap(in->force_N);
  FOR_WHOM(!supervisorAreMotorsAllowedToRun(), &in->force_N) {
    for (int i = 0; i < MOTORS; i++) in->force_N[i] = 0.0f;
  }
  take_range(in, step);
  if (is_pilots()) units_setpoint(&in->setpoint, setpoint);
  if (GLUE.flight.phase == 1) take_rarely(in, setpoint);
  in->no_lesson = !supervisorIsFlying();
}

// Judges before flight whether the sensors contradict each other; in flight the guard does.
static void judge_flyable(const flight_in_t *in) {
  FOR_WHOM(!supervisorIsFlying(), &GLUE.flyable) {
    flyable_step(&GLUE.flyable, in->acc_b_mps2, in->rate_b_radps, in->q_wb);
  }
}

// Fades from one controller to the other over a second; at once while not flying.
static void hand_over(bool flying) {
  const float wanted = GLUE.shadow ? 1.0f : 0.0f, step = 1.0f / HAND_OVER_MS;
  const float left = wanted - GLUE.stock_share;
  GLUE.stock_share += flying ? f_clamp(left, -step, step) : left;
}

// Runs the stock controller. It commands roll, pitch and yaw at 500 Hz and expects them to stay in *control
// in between, where our forces have overwritten them.
static void run_stock(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                      const state_t *state, uint32_t step) {
  control->roll = GLUE.stock.roll;
  control->pitch = GLUE.stock.pitch;
  control->yaw = GLUE.stock.yaw;
  controllerPid(control, setpoint, sensors, state, step);
  GLUE.stock.roll = control->roll;
  GLUE.stock.pitch = control->pitch;
  GLUE.stock.yaw = control->yaw;
}

// Resets the stock controller, which last flew long ago, or never: its heading for yaw rates and its
// integrals are old. A set point without thrust clears both; in step 0 each of its loops runs.
static void start_stock(control_t *control, const sensorData_t *sensors, const state_t *state) {
  static const setpoint_t NOTHING = {.thrust = 0.0f};
  run_stock(control, &NOTHING, sensors, state, 0);
}

static APART void command(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                          const state_t *state, uint32_t step) {
  float force_N[MOTORS];
  for (int i = 0; i < MOTORS; i++) force_N[i] = GLUE.flight.out.motors.force_N[i];
  const bool flew = GLUE.stock_share > 0.0f;
  hand_over(supervisorIsFlying());
  if (GLUE.stock_share > 0.0f) {
    if (!flew) start_stock(control, sensors, state);
    run_stock(control, setpoint, sensors, state, step);
    if (GLUE.stock_share >= 1.0f) return;
    float stock_N[MOTORS];
    units_applied(stock_N, control);
    for (int i = 0; i < MOTORS; i++) force_N[i] += GLUE.stock_share * (stock_N[i] - force_N[i]);
  }
  units_command(control, force_N);
}

void controllerOutOfTree(control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                         const state_t *state, const stabilizerStep_t step) {
  settings_take();
  take_inputs(control, setpoint, sensors, state, step);
  judge_flyable(&GLUE.in);
  const bool grounded = GLUE.flyable.not_flyable != 0;
  if (grounded && GLUE.flight.guard.action != GUARD_HAND_OVER) // only a pilot ends a hand-over
    GLUE.in.setpoint = (flight_setpoint_t){.yaw = YAW_RATE};
  (void)flight_step(&GLUE.flight, &GLUE.in);
  settings_mend();
  GLUE.learning = settings_learning();
  if (grounded)
    units_command(control, (const float[MOTORS]){0.0f, 0.0f, 0.0f, 0.0f});
  else
    command(control, setpoint, sensors, state, step);
  recorder_call();
}
