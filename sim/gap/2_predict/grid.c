// grid.c - a part of a flight on a coarser grid.
#include "gap/2_predict/grid.h"

#include "body/points.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define POINT_HZ  50.0
#define CLEAR_M   5e-3  // nearer to the floor, it touches
#define TOP_M     2e-3  // nearer to the ceiling, it touches
#define FLOOR_M   0.04  // of an upward range sensor that the vehicle file does not describe
#define NOISE_M   0.005 // of the same
#define NOISES    5.0   // sd above its floor from which on a reading is not there by chance
#define NOMINAL_V 3.7   // where no voltage is logged

const char *const gap_channel[CHANNELS] = {"force_x", "force_y", "force_z", "turn_x",
                                           "turn_y",  "turn_z",  "range"};
const char *const gap_unit[CHANNELS] = {"m/s2", "m/s2", "m/s2", "rad/s2", "rad/s2", "rad/s2", "m"};

static bool has(const gap_flight_t *f, int from, int to) {
  for (int i = from; i <= to; i++)
    if (!f->v[i]) return false;
  return true;
}

// --- commands -----------------------------------------------------------------------------------------

// True if each motor's command is known, not only their sum.
static bool each_commanded(const gap_flight_t *f) {
  return has(f, SIG_F1, SIG_F4) || (f->motors_N && has(f, SIG_M1, SIG_M4));
}

static double newton(const gap_flight_t *f, int rotor, int i) {
  if (!each_commanded(f)) return f->v[SIG_THRUST][i] / ROTORS;
  return f->v[(has(f, SIG_F1, SIG_F4) ? SIG_F1 : SIG_M1) + rotor][i];
}

static bool has_commands(const gap_flight_t *f) {
  return each_commanded(f) || f->v[SIG_THRUST];
}

static bool has_speeds(const gap_flight_t *f) {
  for (int k = 0; k < ROTORS; k++)
    if (!f->v[SIG_W1 + k]) return false;
  return true;
}

static done_t take_commands(grid_t *g, const model_t *m, int n, why_t *why) {
  const gap_flight_t *f = g->flight;
  const bool commands = has_commands(f);
  g->by_speeds = !commands;
  g->has_moments = each_commanded(f) || !commands;
  for (int k = 0; k < ROTORS; k++) {
    g->command_N[k] = malloc((size_t)n * sizeof(double));
    if (!g->command_N[k]) return error_failed(why, "out of memory");
    double last = 0.0;
    for (int i = 0; i < n; i++) {
      const double speed = commands ? 0.0 : f->v[SIG_W1 + k][g->from + i];
      const double now = commands ? newton(f, k, g->from + i) : m->frame.kf_Ns2 * speed * speed;
      g->command_N[k][i] = last = isfinite(now) ? now : last;
    }
  }
  return DONE;
}

// --- points -------------------------------------------------------------------------------------------

static double mean(const double *v, int from, int n) {
  double sum = 0.0;
  for (int i = from; i < from + n; i++) sum += v[i];
  return sum / n;
}

static d3_t mean3(const gap_flight_t *f, int signal, int from, int n) {
  return d3(mean(f->v[signal], from, n), mean(f->v[signal + 1], from, n), mean(f->v[signal + 2], from, n));
}

// Returns the mean attitude. A quaternion and its opposite are the same one.
static dq_t mean_attitude(const gap_flight_t *f, int from, int n) {
  dq_t sum = {0.0, 0.0, 0.0, 0.0};
  for (int i = from; i < from + n; i++) {
    const dq_t q = {f->v[SIG_QW][i], f->v[SIG_QX][i], f->v[SIG_QY][i], f->v[SIG_QZ][i]};
    const double way = sum.w * q.w + sum.x * q.x + sum.y * q.y + sum.z * q.z < 0.0 ? -1.0 : 1.0;
    sum = (dq_t){sum.w + way * q.w, sum.x + way * q.x, sum.y + way * q.y, sum.z + way * q.z};
  }
  return isfinite(sum.w) ? dq_unit(sum) : sum;
}

static void take_range(const grid_t *g, int from, grid_point_t *p) {
  const double *range = g->range_up ? g->flight->v[SIG_RANGE] : g->flight->v[SIG_RANGE_DOWN];
  p->range_m = (double)NAN;
  for (int i = from; range && i < from + g->every && isnan(p->range_m); i++)
    if (isfinite(range[i])) {
      p->range_m = range[i];
      p->range_before_s = p->t_s - g->flight->t_s[i] + g->flight->range_late_s[g->range_up ? 0 : 1];
    }
}

// Returns the distance, by height or by reading, below which an upward range sensor is at its floor. A sensor
// that reads too little gets there before the vehicle does.
static double blind_m(const range_told_t *told) {
  return told->told ? told->floor_m + NOISES * told->noise_m : FLOOR_M + NOISES * NOISE_M;
}

static bool finite3(d3_t a) {
  return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static bool is_good(const grid_t *g, const grid_point_t *p, const model_t *m, int from) {
  double thrust_N = 0.0;
  for (int k = 0; k < ROTORS; k++) thrust_N += mean(g->command_N[k], from - g->from, g->every);
  for (int i = from; i < from + g->every; i++)
    if (g->flight->saturated && g->flight->saturated[i]) return false;
  if (p->touches) return false;
  return thrust_N > GAP_CARRIED * m->mass_kg * G_MPS2 && finite3(p->pos_w_m) && finite3(p->vel_w_mps) &&
         finite3(p->rate_b_radps) && finite3(p->acc_b_mps2) && isfinite(p->q_wb.w) && isfinite(p->vbat_V);
}

static grid_point_t point_of(const grid_t *g, const model_t *m, const touch_t *touch, int from) {
  const gap_flight_t *f = g->flight;
  const int n = g->every;
  grid_point_t p = {
      .t_s = mean(f->t_s, from, n), .segment = f->segment ? f->segment[from] : 0, .q_wb = {.w = 1.0}};
  if (g->has_position)
    p.pos_w_m = mean3(f, SIG_X, from, n);
  else if (f->v[SIG_Z])
    p.pos_w_m.z = mean(f->v[SIG_Z], from, n);
  p.pos_w_m.z += body_rest_z_m(m);
  if (g->has_velocity) p.vel_w_mps = mean3(f, SIG_VX, from, n);
  if (g->has_attitude) p.q_wb = mean_attitude(f, from, n);
  if (g->has_rates) p.rate_b_radps = mean3(f, SIG_GX, from, n);
  if (g->has_force) p.acc_b_mps2 = mean3(f, SIG_AX, from, n);
  p.vbat_V = g->has_vbat ? mean(f->v[SIG_VBAT], from, n) : NOMINAL_V;
  const double above_m = m->ceiling_m - p.pos_w_m.z - body_rotor_z_m(m);
  take_range(g, from, &p);
  if (g->range_up && fmin(above_m, p.range_m) < blind_m(&m->range_up)) p.range_m = (double)NAN;
  set_point_read(g, m, from, &p);
  const axes_t axes = axes_of(p.q_wb);
  const touch_gap_t gap = touch_gap(touch, p.pos_w_m, &axes);
  const bool known = finite3(p.pos_w_m) && isfinite(p.q_wb.w);
  p.clear_m = !g->has_position ? HUGE_VAL : known ? fmin(gap.floor_m, gap.ceiling_m) : (double)NAN;
  p.touches = g->has_position && (gap.floor_m < CLEAR_M || gap.ceiling_m < TOP_M);
  p.ok = is_good(g, &p, m, from);
  return p;
}

// Takes the measured thrust of the next point.
static void take_speeds(grid_t *g, const model_t *m, int from) {
  for (int k = 0; k < ROTORS; k++) {
    const double speed = mean(g->flight->v[SIG_W1 + k], from, g->every);
    g->measured_N[k][g->n] = m->frame.kf_Ns2 * speed * speed;
  }
}

static bool speeds_room(grid_t *g, size_t points) {
  if (!has_speeds(g->flight) || !has_commands(g->flight)) return true;
  for (int k = 0; k < ROTORS; k++)
    if (!(g->measured_N[k] = malloc((points + 1) * sizeof(double)))) return false;
  return true;
}

// Points do not reach over the end of a segment.
static void take_points(grid_t *g, const model_t *m, int to) {
  body_t b = {.model = m}; // for its points that can touch
  body_surround(&b.touch, m);
  body_place(&b, d3(0.0, 0.0, 0.0));
  for (int i = g->from; i + g->every <= to;) {
    const int *segment = g->flight->segment;
    if (segment && segment[i] != segment[i + g->every - 1]) {
      i++;
      continue;
    }
    if (g->measured_N[0]) take_speeds(g, m, i);
    g->point[g->n++] = point_of(g, m, &b.touch, i);
    i += g->every;
  }
}

// Returns the point before (way -1) or after (1), of the same segment; at an end the point itself.
static const grid_point_t *beside(const grid_t *g, int j, int way) {
  const int other = j + way;
  const bool there = other >= 0 && other < g->n && g->point[other].segment == g->point[j].segment;
  return &g->point[there ? other : j];
}

static d3_t per_span(d3_t change, const grid_point_t *before, const grid_point_t *after) {
  const double span_s = after->t_s - before->t_s;
  return span_s > 0.0 ? d3_scale(1.0 / span_s, change) : d3(0.0, 0.0, 0.0);
}

// Where no velocity is logged: differentiates the position over the points before and after. A point beside
// one without a position is not ok.
static void make_velocity(grid_t *g) {
  for (int j = 0; j < g->n; j++) {
    const grid_point_t *const a = beside(g, j, -1), *const b = beside(g, j, 1);
    g->point[j].vel_w_mps = per_span(d3_sub(b->pos_w_m, a->pos_w_m), a, b);
    g->point[j].ok = g->point[j].ok && finite3(g->point[j].vel_w_mps);
  }
}

// Where no acceleration is logged: differentiates the velocity likewise, into specific force in body axes.
static void make_acceleration(grid_t *g) {
  for (int j = 0; j < g->n; j++) {
    const grid_point_t *const a = beside(g, j, -1), *const b = beside(g, j, 1);
    const d3_t acc_w = per_span(d3_sub(b->vel_w_mps, a->vel_w_mps), a, b);
    const axes_t axes = axes_of(g->point[j].q_wb);
    g->point[j].acc_b_mps2 = axes_to_body(&axes, d3_add(acc_w, d3(0.0, 0.0, G_MPS2)));
    g->point[j].ok = g->point[j].ok && finite3(g->point[j].acc_b_mps2);
  }
}

done_t grid_make(grid_t *g, const gap_flight_t *f, int from, int to, const model_t *m, why_t *why) {
  *g = (grid_t){.flight = f, .from = from, .samples = to - from};
  g->every = (int)fmax(1.0, floor(f->rate_Hz / POINT_HZ + 1e-3));
  g->period_s = g->every / f->rate_Hz;
  g->command_Hz = f->command_Hz;
  g->slowest_N = m->frame.kf_Ns2 * ROTOR_SLOWEST_RADPS * ROTOR_SLOWEST_RADPS;
  g->has_position = has(f, SIG_X, SIG_Z);
  g->has_velocity = has(f, SIG_VX, SIG_VZ);
  g->has_attitude = has(f, SIG_QW, SIG_QZ);
  g->has_rates = has(f, SIG_GX, SIG_GZ);
  g->has_force = has(f, SIG_AX, SIG_AZ);
  g->has_vbat = f->v[SIG_VBAT] != NULL;
  g->range_up = isfinite(m->ceiling_m) && f->v[SIG_RANGE];
  if (!has_commands(f) && !has_speeds(f))
    return error_set(why, "%s: neither motor commands nor rotor speeds; one of them is needed%s%s", f->name,
                     f->motor_lacks ? "; missing: " : "", f->motor_lacks ? f->motor_lacks : "");
  g->point = malloc((size_t)((to - from) / g->every + 1) * sizeof(grid_point_t));
  if (!g->point || !speeds_room(g, (size_t)((to - from) / g->every)))
    return error_failed(why, "out of memory");
  TRY(take_commands(g, m, to - from, why));
  take_points(g, m, to);
  TRY(grid_leave_out_bumps(g, m, why));
  g->velocity_made = g->has_position && !g->has_velocity;
  if (g->velocity_made) make_velocity(g);
  g->acceleration_made = g->has_velocity && g->has_attitude && !g->has_force;
  if (g->acceleration_made) make_acceleration(g);
  g->has_velocity = g->has_velocity || g->velocity_made;
  g->has_force = g->has_force || g->acceleration_made;
  for (int j = 0; j < g->n; j++) {
    g->point[j].seen_w_m = g->point[j].pos_w_m;
    g->point[j].seen_w_mps = g->point[j].vel_w_mps;
  }
  set_points_judge(g);
  return grid_smooth(g, why);
}

#define COMMANDS_HZ 200.0 // attitude control commands at 500 Hz, and jitters; slower logs miss most of it
#define JITTER      0.98  // of the commands' rate: the least rate of a log that has every command

bool grid_is_slow(const grid_t *g) {
  return g->flight->rate_Hz < (g->command_Hz > 0.0 ? JITTER * g->command_Hz : COMMANDS_HZ);
}

bool grid_misses_commands(const grid_t *g) {
  return grid_is_slow(g) && !g->flight->rows_are_means;
}

void grid_free(grid_t *g) {
  for (int k = 0; k < ROTORS; k++) {
    free(g->command_N[k]);
    free(g->measured_N[k]);
  }
  for (int i = 0; i < GRID_MOTORS; i++) {
    free(g->motors[i].thrust_N[0]);
  }
  points_close(g->eight);
  free(g->point);
  free(g->mark);
  *g = (grid_t){.n = 0};
}
