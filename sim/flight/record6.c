// record6.c - a flight in six degrees of freedom in memory.
#include "flight/record6.h"

#include <math.h>
#include <stdlib.h>

#define FAR_M 0.3 // of the centre of mass

// Far from the ceiling that of the first is near enough.
double record6_gap_m(const body_t *b) {
  if (b->model->ceiling_m - b->y[RIGID_POS_M + 2] > FAR_M) return body_ceiling_gap_m(b, 0);
  double gap_m = body_ceiling_gap_m(b, 0);
  for (int i = 1; i < ROTORS; i++) {
    const double other_m = body_ceiling_gap_m(b, i);
    if (other_m < gap_m) gap_m = other_m;
  }
  return gap_m;
}

static sample_t sample_of(const tick6_t *t) {
  const body_t *b = t->body;
  const axes_t axes = axes_of(t->truth->q_wb);
  const double gap_m = record6_gap_m(b);
  double thrust_N = 0.0, command_N = 0.0, applied_N = 0.0;
  for (int i = 0; i < ROTORS; i++) {
    thrust_N += b->y[RIGID_THRUST_N + i];
    command_N += t->motor_N[i];
    applied_N += t->in->applied_N[i];
  }
  return (sample_t){
      .t_s = t->t_s,
      .setpoint_m = t->setpoint_m,
      .z_m = t->truth->pos_w_m.z + body_rotor_z_m(b->model),
      .climb_mps = t->truth->vel_w_mps.z,
      .acc_mps2 = d3_dot(axes_up_b(&axes), t->truth->force_b_mps2) - 9.81,
      .gap_m = gap_m,
      .gap_min_m = fmin(t->gap_min_m, gap_m),
      .thrust_N = thrust_N,
      .command_N = command_N,
      .ratio = body_thrust_ratio(b, 0),
      .contacts = b->ceiling_contacts,
      .touching = b->on_ceiling,
      .sense = {.z_m = t->in->pos_w_m.z,
                .climb_mps = t->in->vel_w_mps.z,
                .acc_mps2 = t->in->acc_b_mps2.z - 9.81,
                .applied_N = applied_N,
                .range_new = t->range_new,
                .range_m = t->range_m},
      .thoughts = *t->thoughts,
  };
}

// What the mixer of the firmware must have been given: the inverse of its plus and minus, roll and pitch
// halved.
static void take_command(sample6_t *s, double full_N) {
  const double k = 65535.0 / full_N, *f = s->motor_N;
  s->command_roll = 0.5 * k * (-f[0] - f[1] + f[2] + f[3]);
  s->command_pitch = 0.5 * k * (f[0] - f[1] - f[2] + f[3]);
  s->command_yaw = 0.25 * k * (f[0] - f[1] + f[2] - f[3]);
  s->command_thrust = 0.25 * k * (f[0] + f[1] + f[2] + f[3]);
}

static sample6_t more_of(const tick6_t *t) {
  sample6_t s = {
      .tilt_rad = acos(fmax(-1.0, fmin(1.0, t->up_min))),
      .pos_w_m = t->truth->pos_w_m,
      .vbat_V = t->body->vbat_V,
      .estimate = *t->estimate,
      .gyro_b_radps = t->in->gyro_b_radps,
      .acc_b_mps2 = t->in->acc_b_mps2,
      .setpoint_z_m = t->in->set.pos_w_m.z,
  };
  for (int i = 0; i < PILOT6_MOTORS; i++) s.motor_N[i] = t->motor_N[i];
  take_command(&s, t->body->model->thrust_max_N / PILOT6_MOTORS);
  return s;
}

static done_t reserve6(record6_t *more, int room) {
  if (room <= more->room) return DONE;
  sample6_t *bigger = realloc(more->sample, (size_t)room * sizeof *bigger);
  if (!bigger) return FAILED;
  more->sample = bigger;
  more->room = room;
  return DONE;
}

done_t record6_reserve(record_t *record, record6_t *more, int room, why_t *why) {
  if (record_reserve(record, room) == DONE && reserve6(more, room) == DONE) return DONE;
  return error_failed(why, "out of memory");
}

static done_t keep6(record6_t *more, int n, const sample6_t *sample) {
  if (n > more->room) TRY(reserve6(more, more->room ? 2 * more->room : 4096));
  more->sample[n - 1] = *sample;
  return DONE;
}

done_t record6_add(record_t *record, record6_t *more, const tick6_t *tick, why_t *why) {
  const sample_t s = sample_of(tick);
  const sample6_t s6 = more_of(tick);
  if (record_add(record, &s) == DONE && keep6(more, record->n, &s6) == DONE) return DONE;
  return error_failed(why, "out of memory");
}

void record6_free(record6_t *r) {
  free(r->sample);
  *r = (record6_t){0};
}
