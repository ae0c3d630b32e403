// pil.c - one call of the app as a record of words.
#include "pil/pil.h"

#include "controller.h"
#include "firmware/glue.h"
#include "firmware/settings.h"
#include "log.h"
#include "range.h"
#include "stand_in.h"
#include <string.h>

#define COPY3(to, from)                                                                                      \
  do {                                                                                                       \
    (to)[0] = (from).x;                                                                                      \
    (to)[1] = (from).y;                                                                                      \
    (to)[2] = (from).z;                                                                                      \
  } while (0)
#define BACK3(to, from)                                                                                      \
  do {                                                                                                       \
    (to).x = (from)[0];                                                                                      \
    (to).y = (from)[1];                                                                                      \
    (to).z = (from)[2];                                                                                      \
  } while (0)

void pil_pack(pil_in_t *in, const setpoint_t *sp, const sensorData_t *sensors, const state_t *state,
              uint32_t step) {
  in->step = step;
  COPY3(in->acc, sensors->acc);
  COPY3(in->gyro, sensors->gyro);
  COPY3(in->pos, state->position);
  COPY3(in->vel, state->velocity);
  COPY3(in->q, state->attitudeQuaternion);
  in->q[3] = state->attitudeQuaternion.w;
  memcpy(in->att, &state->attitude.roll, sizeof in->att);
  const setpoint_mode_t *m = &sp->mode;
  const uint32_t mode[7] = {m->x, m->y, m->z, m->roll, m->pitch, m->yaw, m->quat};
  memcpy(in->mode, mode, sizeof mode);
  in->in_body = sp->velocity_body;
  memcpy(in->sp_att, &sp->attitude.roll, sizeof in->sp_att);
  memcpy(in->sp_rate, &sp->attitudeRate.roll, sizeof in->sp_rate);
  COPY3(in->sp_q, sp->attitudeQuaternion);
  in->sp_q[3] = sp->attitudeQuaternion.w;
  in->sp_thrust = sp->thrust;
  COPY3(in->sp_pos, sp->position);
  COPY3(in->sp_vel, sp->velocity);
  COPY3(in->sp_acc, sp->acceleration);
}

void pil_unpack(const pil_in_t *in, setpoint_t *sp, sensorData_t *sensors, state_t *state) {
  BACK3(sensors->acc, in->acc);
  BACK3(sensors->gyro, in->gyro);
  BACK3(state->position, in->pos);
  BACK3(state->velocity, in->vel);
  BACK3(state->attitudeQuaternion, in->q);
  state->attitudeQuaternion.w = in->q[3];
  memcpy(&state->attitude.roll, in->att, sizeof in->att);
  const uint32_t *m = in->mode;
  *sp = (setpoint_t){.timestamp = 0};
  sp->mode = (setpoint_mode_t){(stab_mode_t)m[0], (stab_mode_t)m[1], (stab_mode_t)m[2], (stab_mode_t)m[3],
                               (stab_mode_t)m[4], (stab_mode_t)m[5], (stab_mode_t)m[6]};
  sp->velocity_body = in->in_body != 0;
  memcpy(&sp->attitude.roll, in->sp_att, sizeof in->sp_att);
  memcpy(&sp->attitudeRate.roll, in->sp_rate, sizeof in->sp_rate);
  BACK3(sp->attitudeQuaternion, in->sp_q);
  sp->attitudeQuaternion.w = in->sp_q[3];
  sp->thrust = in->sp_thrust;
  BACK3(sp->position, in->sp_pos);
  BACK3(sp->velocity, in->sp_vel);
  BACK3(sp->acceleration, in->sp_acc);
}

// --- the call ---------------------------------------------------------------------------------------------

static stand_in_t around = {.app = &glue_static,
                            .thrust_max_N = 0.12f,
                            .volt_N = {-0.0148307449f, 0.0472446524f, -0.0184736436f, 0.00596092394f}};
static control_t control;
static setpoint_t setpoint;
static sensorData_t sensors;
static state_t state;
static uint32_t step;

// Writes as the parameter task does: the value, and then the callback.
static void write_param(const pil_in_t *in) {
  if (in->param == PIL_NO_PARAM) return;
  if (in->param == PIL_COMMIT) {
    glue_static.commit = in->value == 1.0f ? 1 : 2;
  } else {
    const param_row_t *row = &params_table[in->param];
    const int32_t whole = in->value >= -1e9f && in->value <= 1e9f ? (int32_t)in->value : 1000000000;
    const bool is_float = row->type == PARAM_FLOAT;
    memcpy((char *)&glue_static.tuned + row->offset,
           is_float ? (const void *)&in->value : (const void *)&whole, 4);
  }
  settings_touched();
}

void pil_before(const pil_in_t *in) {
  stand_in = &around;
  pil_unpack(in, &setpoint, &sensors, &state);
  step = in->step;
  around.range_mm[rangeUp] = (uint16_t)in->range_mm;
  around.range_mm[rangeDown] = (uint16_t)in->down_mm;
  around.battery_V = in->battery_V;
  for (int i = 0; i < 4; i++) around.duty[i] = (uint16_t)in->duty[i];
  around.flying = (in->flags & PIL_FLYING) != 0;
  around.motors_allowed = (in->flags & PIL_ALLOWED) != 0;
  around.can_fly = (in->flags & PIL_CAN_FLY) != 0;
  if (in->flags & PIL_START) {
    params_default(&glue_static.tuned);
    glue_static.shadow = 0;
    memcpy(control.normalizedForces, in->applied, sizeof in->applied);
    control.controlMode = controlModeForce;
    controllerOutOfTreeInit();
  }
  write_param(in);
}

void pil_call(void) {
  controllerOutOfTree(&control, &setpoint, &sensors, &state, step);
}

// One pattern for all NaNs, because a processor may choose their bits.
static uint32_t one_nan(uint32_t bits) {
  return (bits & 0x7fffffffu) > 0x7f800000u ? 0x7fc00000u : bits;
}

static uint32_t word_of(const section_log_t *log) {
  uint8_t small;
  uint32_t bits;
  if (log->type == LOG_UINT8) {
    memcpy(&small, log->address, sizeof small);
    return small;
  }
  memcpy(&bits, log->address, sizeof bits);
  return log->type == LOG_FLOAT ? one_nan(bits) : bits;
}

// Returns the next group by name, because every compiler orders them differently.
static const section_log_group_t *after(const section_log_group_t *last) {
  const section_log_group_t *const *group, *next = NULL;
  const int groups = sections_log_groups(&group);
  for (int g = 0; g < groups; g++) {
    const bool later = !last || strcmp(group[g]->name, last->name) > 0;
    if (later && (!next || strcmp(group[g]->name, next->name) < 0)) next = group[g];
  }
  return next;
}

static int read_logs(uint32_t *word, int room) {
  int n = 0;
  for (const section_log_group_t *group = after(NULL); group; group = after(group))
    for (const section_log_t *log = group->log; log->name; log++, n++)
      if (n < room) word[n] = word_of(log);
  return n;
}

void pil_after(pil_out_t *out) {
  memset(out, 0, sizeof *out);
  for (int i = 0; i < 4; i++) {
    memcpy(&out->word[i], &control.normalizedForces[i], sizeof out->word[i]);
    out->word[i] = one_nan(out->word[i]);
  }
  (void)read_logs(out->word + 4, PIL_WORDS - 4);
}

int pil_words(void) {
  uint32_t word[PIL_WORDS];
  return 4 + read_logs(word, 0);
}

int pil_floats(void) {
  int n = 4;
  for (const section_log_group_t *group = after(NULL); group; group = after(group))
    for (const section_log_t *log = group->log; log->name; log++) n += log->type == LOG_FLOAT;
  return n;
}
