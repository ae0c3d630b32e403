// record.c - a flight in memory, and as a log.
#include "flight/record.h"

#include "base/constants.h"
#include "base/larger.h"
#include "base/pen.h"
#include "crazyflie/sections.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define APP_LOGS_MAX 256

// Sets what the firmware's mixer must have been given: inverts its sums, in which roll and pitch are halved.
static void take_command(sample_t *s, double full_N) {
  const double k = 65535.0 / full_N, *f = s->motor_N;
  s->command_roll = 0.5 * k * (-f[0] - f[1] + f[2] + f[3]);
  s->command_pitch = 0.5 * k * (f[0] - f[1] - f[2] + f[3]);
  s->command_yaw = 0.25 * k * (f[0] - f[1] + f[2] - f[3]);
  s->command_thrust = 0.25 * k * (f[0] + f[1] + f[2] + f[3]);
}

// Fills *s in place, because another copy would take as long.
static void take_sample(const tick_t *t, sample_t *restrict s) {
  const body_t *b = t->body;
  const axes_t axes = axes_of(t->truth->q_wb);
  const double gap_m = body_gap_m(b);
  *s = (sample_t){
      .t_s = t->t_s,
      .setpoint_m = t->setpoint_m,
      .z_m = t->truth->pos_w_m.z + body_rotor_z_m(b->model),
      .climb_mps = t->truth->vel_w_mps.z,
      .acc_mps2 = d3_dot(axes_up_b(&axes), t->truth->force_b_mps2) - G_MPS2,
      .gap_m = gap_m,
      .gap_min_m = smaller(t->gap_min_m, gap_m),
      .ratio = body_thrust_ratio(b, 0),
      .contacts = b->ceiling_contacts,
      .touching = b->on_ceiling,
      .sense = {.z_m = t->in->pos_w_m.z,
                .climb_mps = t->in->vel_w_mps.z,
                .acc_mps2 = t->in->acc_b_mps2.z - G_MPS2,
                .range_new = t->range_new,
                .range_m = t->range_m},
      .thoughts = *t->thoughts,
      .tilt_rad = acos(larger(-1.0, smaller(1.0, t->up_min))),
      .pos_w_m = t->truth->pos_w_m,
      .vbat_V = b->vbat_V,
      .estimate = *t->estimate,
      .gyro_b_radps = t->in->gyro_b_radps,
      .acc_b_mps2 = t->in->acc_b_mps2,
      .setpoint_z_m = t->in->set.pos_w_m.z,
  };
  for (int i = 0; i < ROTORS; i++) {
    s->thrust_N += b->y[RIGID_THRUST_N + i];
    s->command_N += t->motor_N[i];
    s->sense.applied_N += t->in->applied_N[i];
    s->motor_N[i] = t->motor_N[i];
  }
  take_command(s, b->model->thrust_max_N / PILOT_MOTORS);
}

done_t record_reserve(record_t *r, int room, why_t *why) {
  if (room <= r->room) return DONE;
  sample_t *more = realloc(r->sample, (size_t)room * sizeof *more);
  if (!more) return error_failed(why, "out of memory");
  r->sample = more;
  r->room = room;
  return DONE;
}

done_t record_add(record_t *r, const tick_t *tick, why_t *why) {
  if (r->n == r->room) TRY(record_reserve(r, r->room ? 2 * r->room : 4096, why));
  take_sample(tick, &r->sample[r->n++]);
  return DONE;
}

void record_free(record_t *r) {
  free(r->sample);
  free(r->app);
  free(r->param);
  *r = (record_t){0};
}

// --- as a log -----------------------------------------------------------------------------------------

static const char NAMES[] =
    "timestamp,ctrltarget.z,stateEstimate.z,stateEstimate.vz,stateEstimate.qw,stateEstimate.qx,"
    "stateEstimate.qy,stateEstimate.qz,acc.x,acc.y,acc.z,range.up,indi.thrust,indi.applied,ceil.zc,"
    "ceil.height,guard.now,guard.latched,ceil.ratio,ceil.slope,rls.y,rls.w1,rls.w2,rls.w3,rls.w4,rls.w5,rls."
    "w6,rls.w7,rls.p1,rls.p2,rls.p3,"
    "rls.p4,rls.p5,rls.p6,rls.p7,sim.z,sim.vz,sim.gap,sim.thrust,sim.ratio,sim.contacts";
static const char MORE_NAMES[] =
    ",stateEstimate.x,stateEstimate.y,stateEstimate.vx,stateEstimate.vy,gyro.x,gyro.y,gyro.z,indi.m1,"
    "indi.m2,indi.m3,indi.m4,pm.vbat,sim.x,sim.y,sim.tilt,controller.r_roll,controller.r_pitch,"
    "controller.r_yaw,controller.cmd_roll,controller.cmd_pitch,controller.cmd_yaw,controller.cmd_thrust";

// True if this log of the app is not a column already.
static bool is_new(const char *name) {
  const char *const lists[] = {NAMES, MORE_NAMES};
  const size_t size = strlen(name);
  for (int i = 0; i < 2; i++) {
    for (const char *at = lists[i]; (at = strstr(at, name)) != NULL; at += size)
      if ((at == lists[i] || at[-1] == ',') && (at[size] == ',' || at[size] == '\0')) return false;
  }
  return true;
}

// Sets which of the app's logs are columns; returns how many logs there are.
static int choose(bool column[APP_LOGS_MAX]) {
  char name[32];
  int n = 0;
  for (; n < APP_LOGS_MAX && sections_log_at(n, name); n++) column[n] = is_new(name);
  return n;
}

static void write_names(FILE *file, const record_t *r, const bool *column, int n) {
  char name[32];
  fputs(NAMES, file);
  if (!r->vertical_only) fputs(MORE_NAMES, file);
  for (int i = 0; i < n; i++)
    if (r->app && column[i] && sections_log_at(i, name)) fprintf(file, ",%s", name);
  fputc('\n', file);
}

// Writes a comma and the value.
static void put(pen_t *pen, int places, double value) {
  pen_char(pen, ',');
  pen_fixed(pen, value, places);
}

static void put3(pen_t *pen, int places, d3_t v) {
  put(pen, places, v.x);
  put(pen, places, v.y);
  put(pen, places, v.z);
}

static void write_attitude(pen_t *pen, const sample_t *s) {
  const dq_t q = s->estimate.q_wb;
  put(pen, 7, q.w);
  put3(pen, 7, d3(q.x, q.y, q.z));
  put3(pen, 6, d3_scale(1.0 / G_MPS2, s->acc_b_mps2));
}

static void write_more(pen_t *pen, const sample_t *s) {
  const d3_t p = s->estimate.pos_w_m, v = s->estimate.vel_w_mps;
  put(pen, 6, p.x);
  put(pen, 6, p.y);
  put(pen, 6, v.x);
  put(pen, 6, v.y);
  put3(pen, 4, d3_scale(DEG_PER_RAD, s->gyro_b_radps));
  for (int i = 0; i < 4; i++) put(pen, 6, s->motor_N[i]);
  put(pen, 4, s->vbat_V);
  put(pen, 6, s->pos_w_m.x);
  put(pen, 6, s->pos_w_m.y);
  put(pen, 4, DEG_PER_RAD * s->tilt_rad);
  const d3_t r = s->gyro_b_radps; // roll right, nose up, counter-clockwise
  put3(pen, 7, d3(r.x, -r.y, r.z));
  put3(pen, 2, d3(s->command_roll, s->command_pitch, s->command_yaw));
  put(pen, 2, s->command_thrust);
}

static void write_thoughts(pen_t *pen, const thoughts_t *th) {
  put(pen, 6, th->zc_m);
  put(pen, 6, th->ceiling_z_m);
  put(pen, 0, th->guard_now);
  put(pen, 0, th->guard_latched);
  put(pen, 6, th->ratio);
  put(pen, 5, th->slope_per_m);
  put(pen, 5, th->y);
  const double *const lists[] = {th->weights, th->variance};
  for (int k = 0; k < 2 * CURVE_WEIGHTS; k++) {
    pen_char(pen, ',');
    pen_general(pen, lists[k / CURVE_WEIGHTS][k % CURVE_WEIGHTS], 7);
  }
}

static void write_sample(pen_t *pen, const sample_t *s, bool vertical_only) {
  pen_fixed(pen, 1e3 * s->t_s, 3);
  put(pen, 4, s->setpoint_z_m);
  put(pen, 6, s->sense.z_m);
  put(pen, 6, s->sense.climb_mps);
  write_attitude(pen, s);
  put(pen, 0, 1e3 * s->sense.range_m);
  put(pen, 6, s->command_N);
  put(pen, 6, s->sense.applied_N);
  write_thoughts(pen, &s->thoughts);
  put3(pen, 6, d3(s->z_m, s->climb_mps, s->gap_m));
  put(pen, 6, s->thrust_N);
  put(pen, 6, s->ratio);
  put(pen, 0, s->contacts);
  if (!vertical_only) write_more(pen, s);
}

// Writes those of a row of the app's logs that are columns; null: all, and the first without a comma.
static void write_app(pen_t *pen, const record_t *r, int row, const bool *column, int n) {
  const float *const app = r->app + (size_t)row * (size_t)n;
  for (int k = 0; k < n; k++) {
    if (column && !column[k]) continue;
    if (column || k) pen_char(pen, ',');
    pen_general(pen, (double)app[k], 9);
  }
}

static void write_calls(const record_t *r, FILE *file) {
  char name[32];
  const int n = sections_logs();
  for (int k = 0; k < n && sections_log_at(k, name); k++) fprintf(file, k ? ",%s" : "%s", name);
  fputc('\n', file);
  pen_t pen;
  pen_begin(&pen, file);
  for (int i = 0; i < r->n_calls; i++) {
    write_app(&pen, r, i, NULL, n);
    pen_char(&pen, '\n');
  }
  pen_flush(&pen);
}

void record_write_names(const record_t *r, FILE *file) {
  bool column[APP_LOGS_MAX];
  const int n = choose(column);
  write_names(file, r, column, n);
}

void record_write_rows(const record_t *r, FILE *file) {
  bool column[APP_LOGS_MAX];
  const int n = choose(column);
  pen_t pen;
  pen_begin(&pen, file);
  for (int i = 0; i < r->n; i++) {
    write_sample(&pen, &r->sample[i], r->vertical_only);
    if (r->app) write_app(&pen, r, i, column, n);
    pen_char(&pen, '\n');
  }
  pen_flush(&pen);
}

void record_write(const record_t *r, FILE *file) {
  if (r->n_calls > 0) {
    write_calls(r, file);
    return;
  }
  record_write_names(r, file);
  record_write_rows(r, file);
}
