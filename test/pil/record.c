// record.c - flies the simulated vehicle and writes every call of the app to a file (record TRACE), or has
// the calls answered elsewhere, over two pipes (record TO FROM).
//
// The trace: a learning flight and a flight with weights, both with the shipped parameters except a longer
// time close to the ceiling (ceil.blindMax); a flight with exactly the shipped parameters, which retreats;
// flights whose inputs, parameters and time are spoiled; and, with the height filter, one that is not spoiled
// and one that is.
#include "controller.h"
#include "range.h"
#include "pilots/param_spec.h"
#include "pil/pil.h"
#include "pilots/pilot_flight.h"
#include "base/random.h"
#include "flight/setup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GROUND_M 0.3f // height of a made-up floor: at gaps of 20 to 4 cm the ladder is over it, up to 15 cm

typedef struct {
  FILE *to, *from; // from: where answers come from, or null
  random_t *random;
  bool first, inputs, params, time; // which are spoiled
  int burst, field;
  uint32_t odd, step_off;
  long calls, differ;
  pilot_flight_t pilot;
  pilot_t inner;
} recorder_t;

// --- spoiling ---------------------------------------------------------------------------------------------

static uint32_t odd_bits(random_t *r) {
  static const uint32_t odd[] = {0x7fc00000, 0x7f800000, 0xff800000, 0x7e967699, 0x00000001,
                                 0x80000000, 0xffc12345, 0x4b000000, 0xc4bb8000};
  const unsigned i = (unsigned)random_uniform(r, 0.0, 12.0);
  return i < sizeof odd / sizeof *odd ? odd[i] : (uint32_t)random_uniform(r, 0.0, 4294967295.0);
}

// Spoils one word of what the firmware measures, estimates or is told, for 1 to 80 calls.
static void spoil_inputs(recorder_t *r, pil_in_t *in) {
  if (r->burst == 0 && random_uniform(r->random, 0.0, 1.0) < 0.004) {
    r->burst = (int)random_uniform(r->random, 1.0, random_uniform(r->random, 0.0, 1.0) < 0.8 ? 3.0 : 80.0);
    r->field = (int)random_uniform(r->random, 0.0, 36.0);
    r->odd = odd_bits(r->random);
  }
  if (r->burst == 0) return;
  r->burst--;
  float *const word = r->field < 19 ? in->acc + r->field : in->sp_att + (r->field - 19);
  if (r->field == 0 && (r->odd & 1)) in->range_mm = r->odd & 0xffff;
  if (r->field == 1 && (r->odd & 1)) in->down_mm = r->odd & 0xffff;
  memcpy(word, &r->odd, sizeof *word);
}

// A battery too weak for what is asked for, and motors as the firmware's cap leaves them.
static void spoil_battery(recorder_t *r, pil_in_t *in) {
  if (random_uniform(r->random, 0.0, 1.0) > 0.2) return;
  in->battery_V = (float)random_uniform(r->random, 2.2, 3.1);
  for (int i = 0; i < 4; i++) in->duty[i] = (uint32_t)random_uniform(r->random, 40000.0, 65535.0);
  in->duty[(int)random_uniform(r->random, 0.0, 4.0 - 1e-9)] = 65535;
}

static void spoil_params(recorder_t *r, pil_in_t *in) {
  if (random_uniform(r->random, 0.0, 1.0) > 0.02) return;
  in->param = (int32_t)random_uniform(r->random, -2.0, params_count - 1e-9);
  if (in->param == PIL_NO_PARAM || in->param == PIL_COMMIT) {
    in->value = random_uniform(r->random, 0.0, 1.0) < 0.5 ? 1.0f : 2.0f;
    in->param = PIL_COMMIT;
    return;
  }
  const param_row_t *row = &params_table[in->param];
  const double kind = random_uniform(r->random, 0.0, 1.0);
  const uint32_t odd = odd_bits(r->random);
  if (kind < 0.6) // near its default
    in->value =
        row->type == PARAM_INT ? row->initial : row->initial * (float)random_uniform(r->random, 0.9, 1.1);
  else
    memcpy(&in->value, &odd, sizeof odd);
}

static void spoil_time(recorder_t *r, pil_in_t *in) {
  const double chance = random_uniform(r->random, 0.0, 1.0);
  if (chance < 0.002) r->step_off += (uint32_t)random_uniform(r->random, 1.0, 60.0);
  if (chance > 0.999) r->step_off -= (uint32_t)random_uniform(r->random, 1.0, 20.0);
  in->step += r->step_off;
}

static void write_param(recorder_t *r, const pil_in_t *in) {
  if (in->param == PIL_NO_PARAM) return;
  const char *name = in->param == PIL_COMMIT ? "ceil.commit" : params_table[in->param].name;
  (void)crazyflie_set(&r->pilot.vehicle, name, (double)in->value);
}

// --- a call -----------------------------------------------------------------------------------------------

static void spoil(recorder_t *r, pil_in_t *in) {
  if (r->inputs) spoil_inputs(r, in);
  if (r->inputs) spoil_battery(r, in);
  if (r->params) spoil_params(r, in);
  if (r->time) spoil_time(r, in);
}

static void ask(recorder_t *r, control_t *control) {
  pil_out_t out;
  fflush(r->to);
  if (fread(&out, sizeof out, 1, r->from) != 1) {
    fprintf(stderr, "record: the target does not answer\n");
    exit(1);
  }
  r->differ += memcmp(out.word, control->normalizedForces, sizeof control->normalizedForces) != 0;
  memcpy(control->normalizedForces, out.word, sizeof control->normalizedForces);
}

static void fly(void *context, control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
                const state_t *state, uint32_t step) {
  recorder_t *const r = context;
  stand_in_t *const around = &r->pilot.vehicle.around;
  pil_in_t in = {
      .param = PIL_NO_PARAM, .range_mm = around->range_mm[rangeUp], .battery_V = around->battery_V};
  in.down_mm = around->range_mm[rangeDown];
  for (int i = 0; i < 4; i++) in.duty[i] = around->duty[i];
  in.flags = (r->first ? PIL_START : 0u) | (around->flying ? PIL_FLYING : 0u) |
             (around->motors_allowed ? PIL_ALLOWED : 0u) | (around->can_fly ? PIL_CAN_FLY : 0u);
  memcpy(in.applied, control->normalizedForces, sizeof in.applied);
  pil_pack(&in, setpoint, sensors, state, step);
  // The first calls set this flight's parameters, one in each call.
  if (!r->first && r->calls < params_count) in.param = (int32_t)r->calls;
  if (in.param >= 0) in.value = params_get(&r->pilot.param, &params_table[in.param]);
  if (r->calls == params_count) in = (in.param = PIL_COMMIT, in.value = 1.0f, in);
  if (r->calls > 1000) spoil(r, &in);
  if (r->calls > 1000) write_param(r, &in);
  around->battery_V = in.battery_V;
  for (int i = 0; i < 4; i++) around->duty[i] = (uint16_t)in.duty[i];
  r->first = false;
  r->calls++;
  if (fwrite(&in, sizeof in, 1, r->to) != 1) exit(1);
  // What was written down also flies here.
  sensorData_t seen;
  state_t believed;
  setpoint_t wanted;
  pil_unpack(&in, &wanted, &seen, &believed);
  controllerOutOfTree(control, &wanted, &seen, &believed, in.step);
  if (r->from) ask(r, control);
}

static int fly_one(recorder_t *r, fly_kind_t kind, float blind_s, double end_s, uint64_t seed, bool own) {
  setup_t setup;
  why_t why;
  record_t record = {0};
  outcome_t outcome;
  random_close(r->random);
  r->random = random_open(seed);
  r->first = true;
  r->calls = r->burst = 0;
  r->step_off = seed % 2 ? 0xffff0000u : 0u; // some counters wrap on the way
  if (setup_thesis(&setup, kind, &why) != DONE) return error_exit("record", FAILED, &why);
  setup_close_ladder(&setup);
  setup.plan.below_estimate = false; // set points count from the true ceiling
  if (blind_s > 0.0f) setup.flight.guard.blind_max_s = blind_s;
  setup.flight.curve.mode = kind == FLY_INDI_LIVE ? CURVE_LIVE : CURVE_FIXED;
  setup.flight.height.own = own;
  if (own) {
    setup.flight.ground.mode = CURVE_LIVE;
    setup.flight.ground_zero_m = GROUND_M;
  }
  setup.plan.seed = seed;
  setup.plan.integrate = INTEGRATE_RK4;
  setup.plan.end_s = end_s;
  if (pilot_flight_init(&r->pilot, &setup.flight, &setup.model, &r->inner) != DONE) return 1;
  r->pilot.vehicle.fly = fly;
  r->pilot.vehicle.fly_context = r;
  const done_t status = loop_fly(&setup.plan, &setup.model, &r->inner, &record, &outcome, &why);
  if (status == DONE && r->from) printf("%ld calls, %d contacts, ", r->calls, outcome.contacts);
  record_free(&record);
  return status == DONE ? 0 : error_exit("record", status, &why);
}

static int fly_trace(recorder_t *r) {
  static const struct {
    fly_kind_t kind;
    float blind_s; // 0: as shipped
    double end_s;
    bool inputs, params, time, own; // own: flies by height.own and learns over a ground
  } row[] = {{FLY_INDI_LIVE, SETUP_BLIND_S, 62.0, false, false, false, false},
             {FLY_INDI_RBF, SETUP_BLIND_S, 62.0, false, false, false, false},
             {FLY_INDI_RBF, 0.0f, 50.0, false, false, false, false},
             {FLY_INDI_RBF, SETUP_BLIND_S, 25.0, false, true, false, false},
             {FLY_INDI_LIVE, SETUP_BLIND_S, 25.0, true, false, false, false},
             {FLY_INDI_RBF, SETUP_BLIND_S, 25.0, true, true, true, false},
             {FLY_INDI_LIVE, SETUP_BLIND_S, 25.0, true, true, true, false},
             {FLY_INDI_RBF, SETUP_BLIND_S, 62.0, false, false, false, true},
             {FLY_INDI_LIVE, SETUP_BLIND_S, 25.0, true, true, true, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    r->inputs = row[i].inputs;
    r->params = row[i].params;
    r->time = row[i].time;
    if (fly_one(r, row[i].kind, row[i].blind_s, row[i].end_s, 1 + i, row[i].own) != 0) return 1;
  }
  return 0;
}

int main(int argc, char **argv) {
  static recorder_t r;
  if (argc != 2 && argc != 3) {
    fprintf(stderr, "usage: record TRACE, or record TO FROM\n");
    return 2;
  }
  r.to = fopen(argv[1], "wb");
  r.from = argc == 3 && r.to ? fopen(argv[2], "rb") : NULL;
  if (!r.to || (argc == 3 && !r.from)) {
    fprintf(stderr, "record: %s: cannot be opened\n", argv[argc - 1]);
    return 2;
  }
  const int failed = r.from ? fly_one(&r, FLY_INDI_LIVE, SETUP_BLIND_S, 62.0, 1, false) : fly_trace(&r);
  if (r.from) printf("%ld differ\n", r.differ);
  if (r.from) fclose(r.from);
  return fclose(r.to) == 0 && r.differ == 0 ? failed : 1;
}
