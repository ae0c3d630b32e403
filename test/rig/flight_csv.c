// flight_csv.c - logs of a flight whose every signal is known: a cf21_legacy on sine waves, 32.9 g.
#include "rig/flight_csv.h"

#include "plant/rotor.h"
#include "rig/scratch.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define G_MPS2 9.81
#define DEG    (180.0 / 3.14159265358979323846)
#define TURN   6.283185307179586
#define RPM    (60.0 / TURN)

const char *const flight_csv_name[FC_COLUMNS] = {"timestamp",
                                                 "stateEstimate.x",
                                                 "stateEstimate.y",
                                                 "stateEstimate.z",
                                                 "stateEstimate.vx",
                                                 "stateEstimate.vy",
                                                 "stateEstimate.vz",
                                                 "acc.x",
                                                 "acc.y",
                                                 "acc.z",
                                                 "stateEstimate.qw",
                                                 "stateEstimate.qx",
                                                 "stateEstimate.qy",
                                                 "stateEstimate.qz",
                                                 "gyro.x",
                                                 "gyro.y",
                                                 "gyro.z",
                                                 "motor.m1",
                                                 "motor.m2",
                                                 "motor.m3",
                                                 "motor.m4",
                                                 "pm.vbat",
                                                 "range.up",
                                                 "rpm.m1",
                                                 "rpm.m2",
                                                 "rpm.m3",
                                                 "rpm.m4"};

// Two waves per axis: size in metres, frequency in Hz, phase.
static const struct {
  double size_m[2], hz[2], phase[2];
} WAVE[3] = {{{0.30, 0.05}, {0.31, 0.83}, {0.0, 1.0}},
             {{0.25, 0.04}, {0.23, 0.97}, {0.5, 2.0}},
             {{0.15, 0.04}, {0.37, 1.10}, {1.0, 0.3}}};

static double wave(int axis, double t_s, int derivative) {
  double sum = axis == 2 && derivative == 0 ? 0.6 : 0.0;
  for (int k = 0; k < 2; k++) {
    const double w = TURN * WAVE[axis].hz[k], at = w * t_s + WAVE[axis].phase[k];
    sum += WAVE[axis].size_m[k] * pow(w, derivative) * sin(at + 0.25 * TURN * derivative);
  }
  return sum;
}

static void attitude(double t_s, double q[4]) {
  const double r = 0.12 * sin(TURN * 0.9 * t_s) + 0.05 * sin(TURN * 2.3 * t_s + 1.0);
  const double p = 0.10 * sin(TURN * 0.7 * t_s + 0.7) + 0.05 * sin(TURN * 1.9 * t_s);
  const double y = 0.3 * sin(TURN * 0.2 * t_s) + 0.04 * sin(TURN * 1.3 * t_s);
  const double cr = cos(0.5 * r), sr = sin(0.5 * r), cp = cos(0.5 * p), sp = sin(0.5 * p);
  const double cy = cos(0.5 * y), sy = sin(0.5 * y);
  q[0] = cr * cp * cy + sr * sp * sy;
  q[1] = sr * cp * cy - cr * sp * sy;
  q[2] = cr * sp * cy + sr * cp * sy;
  q[3] = cr * cp * sy - sr * sp * cy;
}

// By central differences over 0.2 ms: accurate to 1e-6 rad/s.
static void rate(double t_s, double w[3]) {
  double a[4], b[4];
  attitude(t_s - 1e-4, a);
  attitude(t_s + 1e-4, b);
  w[0] = (a[0] * b[1] - a[1] * b[0] - a[2] * b[3] + a[3] * b[2]) * 1e4;
  w[1] = (a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1]) * 1e4;
  w[2] = (a[0] * b[3] - a[1] * b[2] + a[2] * b[1] - a[3] * b[0]) * 1e4;
}

// What the accelerometer measures (specific force), in g.
static void force(double t_s, double f_g[3]) {
  double q[4], a[3];
  attitude(t_s, q);
  for (int k = 0; k < 3; k++) a[k] = wave(k, t_s, 2) + (k == 2 ? G_MPS2 : 0.0);
  const double w = q[0], x = -q[1], y = -q[2], z = -q[3];
  const double u[3] = {y * a[2] - z * a[1] + w * a[0], z * a[0] - x * a[2] + w * a[1],
                       x * a[1] - y * a[0] + w * a[2]};
  f_g[0] = (a[0] + 2.0 * (y * u[2] - z * u[1])) / G_MPS2;
  f_g[1] = (a[1] + 2.0 * (z * u[0] - x * u[2])) / G_MPS2;
  f_g[2] = (a[2] + 2.0 * (x * u[1] - y * u[0])) / G_MPS2;
}

static const model_t *vehicle(void) {
  static model_t m;
  why_t why;
  if (m.mass_kg == 0.0 && model_builtin("cf21_legacy", &m, &why) != DONE) abort();
  return &m;
}

static void values(double t_s, double att_s, double vel_s, double place_s, double v[FC_COLUMNS]) {
  const model_t *const m = vehicle();
  double w[3];
  v[FC_TIME] = 1e3 * t_s;
  for (int k = 0; k < 3; k++) {
    v[FC_X + k] = wave(k, place_s, 0);
    v[FC_VX + k] = wave(k, vel_s, 1);
  }
  force(t_s, &v[FC_AX]);
  attitude(att_s, &v[FC_QW]);
  rate(t_s, w);
  for (int k = 0; k < 3; k++) v[FC_GX + k] = DEG * w[k];
  v[FC_VBAT] = 3.9 - 0.002 * t_s;
  const double each_N =
      0.25 * m->mass_kg * G_MPS2 * sqrt(v[FC_AX] * v[FC_AX] + v[FC_AY] * v[FC_AY] + v[FC_AZ] * v[FC_AZ]);
  const double pwm = rotor_pwm(&m->map, each_N, v[FC_VBAT], 0.12);
  for (int k = 0; k < 4; k++) {
    v[FC_M1 + k] = pwm;
    v[FC_W1 + k] = RPM * sqrt(each_N / m->frame.kf_Ns2);
  }
  v[FC_RANGE] = floor(1500.0 - 1e3 * wave(2, floor(t_s * 10.0 + 1e-6) / 10.0, 0));
}

void flight_csv_values(double t_s, double v[FC_COLUMNS]) {
  values(t_s, t_s, t_s, t_s, v);
}

columns_t flight_csv_columns(void) {
  columns_t c = columns_crazyflie();
  for (int i = 0; i < SIG_COLUMNS; i++) c.of[i].late_s = 0.0;
  c.of[SIG_RANGE].late_said = c.of[SIG_RANGE_DOWN].late_said = true;
  return c;
}

static size_t write_names(const flight_csv_t *f, char *text, size_t room) {
  size_t used = 0;
  for (int c = 0; c < FC_COLUMNS; c++) {
    if (f->drop && c == f->column) continue;
    const char *const name = f->rename && c == f->column ? f->rename : flight_csv_name[c];
    used += (size_t)snprintf(text + used, room - used, "%s%s", used ? "," : "", name);
  }
  return used + (size_t)snprintf(text + used, room - used, "\n");
}

static void spoil(const flight_csv_t *f, double t_s, double v[FC_COLUMNS]) {
  if (t_s < f->from_s || (f->to_s > 0.0 && t_s >= f->to_s)) return;
  double held[FC_COLUMNS];
  flight_csv_values(f->from_s, held);
  for (int c = f->column; c <= f->column + f->more; c++) {
    if (f->hold_s > 0.0 && t_s < f->from_s + f->hold_s) v[c] = held[c];
    v[c] = v[c] * (f->scale != 0.0 ? f->scale : 1.0) + f->offset;
  }
}

static bool in_its_place(const flight_csv_t *f, int c, int row) {
  return f->cell && c == f->column && (f->every == 0 || row % f->every == 0);
}

static void late_commands(double t_s, double v[FC_COLUMNS]) {
  double then[FC_COLUMNS];
  flight_csv_values(t_s, then);
  memcpy(&v[FC_M1], &then[FC_M1], 4 * sizeof *v);
}

size_t flight_csv_write(const flight_csv_t *f, char *text, size_t room) {
  const double dt_s = 1e-3 * (f->dt_ms > 0.0 ? f->dt_ms : 10.0);
  const int from = (int)(f->from_s / dt_s + 0.5), rows = f->rows ? f->rows : 2000;
  size_t used = write_names(f, text, room);
  for (int i = 0; i < rows && used < room - 600; i++) {
    if (i >= from && i < from + f->gap_rows) continue;
    const bool same = i > from && i <= from + f->same_rows;
    const double t_s = dt_s * (same ? from : i);
    double v[FC_COLUMNS];
    const double stands_s = f->repeats_att ? dt_s * (i % f->repeats_att) : 0.0;
    values(t_s, t_s - f->late_att_s - stands_s, t_s - f->late_vel_s, t_s - f->late_vel_s - f->late_place_s,
           v);
    if (f->late_cmd_s != 0.0) late_commands(t_s - f->late_cmd_s, v);
    spoil(f, t_s, v);
    bool first = true;
    for (int c = 0; c < FC_COLUMNS; c++) {
      if (f->drop && c == f->column) continue;
      if (in_its_place(f, c, i))
        used += (size_t)snprintf(text + used, room - used, "%s%s", first ? "" : ",", f->cell);
      else
        used += (size_t)snprintf(text + used, room - used, "%s%.9g", first ? "" : ",", v[c]);
      first = false;
    }
    used += (size_t)snprintf(text + used, room - used, "\n");
  }
  return used;
}

const char *flight_csv_file(const flight_csv_t *f, const char *name) {
  const size_t room = 16u << 20;
  char *const text = malloc(room);
  if (!text) abort();
  const char *const path = scratch_file(name, text, (long)flight_csv_write(f, text, room));
  free(text);
  return path;
}
