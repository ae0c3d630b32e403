// nature.c - see nature.h.
#include "exam/other/nature.h"

#include <string.h>

typedef struct {
  vec_t force_b_N, moment_b_Nm;
} wrench_t;

double nature_hover_radps(const nature_t *n) {
  return sqrt(n->mass_kg * NATURE_G_MPS2 / (4.0 * n->k_Ns2));
}

// --- thrust and drag ---------------------------------------------------------------------------------------

double nature_ceiling_gain(const nature_t *n, double height_m) {
  if (!(n->ceiling_share > 0.0)) return 0.0;
  const double far = fmax(n->ceiling_m - height_m, 0.0) / n->ceiling_m0;
  return n->ceiling_share / ((1.0 + far * far) * (1.0 + far * far));
}

double nature_ground_gain(const nature_t *n, double height_m) {
  const double near = n->radius_m / (4.0 * fmax(height_m, 0.5 * n->radius_m));
  return n->ground_share * near * near;
}

static double surfaces(const nature_t *n, double height_m) {
  return 1.0 + nature_ceiling_gain(n, height_m) + nature_ground_gain(n, height_m);
}

static double thrust_N(const nature_flight_t *f, int i, double radps) {
  const nature_t *const n = f->nature;
  const double plain_N = n->k_Ns2 * radps * radps, off_N = plain_N - 0.25 * n->mass_kg * NATURE_G_MPS2;
  const double volts = 1.0 - n->sag * (1.0 - f->volt / n->sag_V);
  return n->gain[i] * volts * (plain_N + n->bend_pN * off_N * off_N);
}

static void at_hub(const nature_flight_t *f, const nature_state_t *s, vec_t air_b, int i, wrench_t *w) {
  const nature_t *const n = f->nature;
  const vec_t at = vec(n->x_m[i], n->y_m[i], 0.0);
  const vec_t v = vec_add(air_b, vec_cross(s->rate_radps, at));
  const double speed = s->rotor_radps[i];
  const double height_m = s->pos_m.z + turn_to_world(s->q, at).z;
  const double up_N =
      thrust_N(f, i, speed) * surfaces(n, height_m) + 0.25 * n->lift_kgpm * (v.x * v.x + v.y * v.y);
  const vec_t force =
      vec(-n->hub_kg * speed * v.x, -n->hub_kg * speed * v.y, up_N - n->climb_kg * speed * v.z);
  const double flap = n->flap_kgm * speed;
  w->force_b_N = vec_add(w->force_b_N, force);
  w->moment_b_Nm = vec_add(w->moment_b_Nm, vec_cross(at, force));
  w->moment_b_Nm = vec_add(
      w->moment_b_Nm, vec(flap * v.y, -flap * v.x, -n->spin[i] * n->torque_m * n->k_Ns2 * speed * speed));
}

// --- outside the library -----------------------------------------------------------------------------------

static vec_t strange_N(const nature_flight_t *f, const nature_state_t *s) {
  const nature_t *const n = f->nature;
  const double x = s->pos_m.x - n->strange_at[0], y = s->pos_m.y - n->strange_at[1], wide = n->strange_at[2];
  const vec_t side = vec(n->strange_N, 0.0, 0.0);
  switch (n->strange) {
  case STRANGE_PLACE: return vec(0.0, 0.0, n->strange_N * exp(-(x * x + y * y) / (wide * wide)));
  case STRANGE_LAYER: return fabs(s->pos_m.z - n->strange_at[0]) < wide ? side : vec(0.0, 0.0, 0.0);
  case STRANGE_CORNER:
    return x > 0.0 && y > 0.0 ? vec(-n->strange_N, -n->strange_N, 0.0) : vec(0.0, 0.0, 0.0);
  case STRANGE_PULSES:
    return fmod(f->t_s, n->strange_at[0]) < wide ? vec(0.0, n->strange_N, 0.0) : vec(0.0, 0.0, 0.0);
  case STRANGE_SHAKE: return vec_times(sin(2.0 * OTHER_PI * n->strange_at[0] * f->t_s), side);
  default: return vec(0.0, 0.0, 0.0);
  }
}

// --- the body ----------------------------------------------------------------------------------------------

static wrench_t wrench_of(const nature_flight_t *f, const nature_state_t *s) {
  const nature_t *const n = f->nature;
  const vec_t air_b = turn_to_body(s->q, vec_more(s->vel_mps, -1.0, n->air_mps));
  const double speed = vec_length(air_b);
  wrench_t w = {{-n->body_kgpm[0] * speed * air_b.x, -n->body_kgpm[1] * speed * air_b.y,
                 -n->body_kgpm[2] * speed * air_b.z},
                {0.0, 0.0, 0.0}};
  for (int i = 0; i < 4; i++) at_hub(f, s, air_b, i, &w);
  const vec_t world_N = vec_add(n->push_N, strange_N(f, s));
  w.force_b_N = vec_add(w.force_b_N, turn_to_body(s->q, world_N));
  return w;
}

static nature_state_t advanced(const nature_flight_t *f, const nature_state_t *from,
                               const nature_state_t *slope_at, const double command_radps[4], double h_s,
                               vec_t *force_b_N) {
  const nature_t *const n = f->nature;
  const wrench_t w = wrench_of(f, slope_at);
  const vec_t r = slope_at->rate_radps;
  const vec_t spun = vec(n->inertia_kgm2[0] * r.x, n->inertia_kgm2[1] * r.y, n->inertia_kgm2[2] * r.z);
  const vec_t m = vec_more(w.moment_b_Nm, -1.0, vec_cross(r, spun));
  const vec_t acc = vec_add(vec_times(1.0 / n->mass_kg, turn_to_world(slope_at->q, w.force_b_N)),
                            vec(0.0, 0.0, -NATURE_G_MPS2));
  nature_state_t to = *from;
  to.pos_m = vec_more(from->pos_m, h_s, slope_at->vel_mps);
  to.vel_mps = vec_more(from->vel_mps, h_s, acc);
  to.rate_radps = vec_more(from->rate_radps, h_s,
                           vec(m.x / n->inertia_kgm2[0], m.y / n->inertia_kgm2[1], m.z / n->inertia_kgm2[2]));
  to.q = turn_by(from->q, vec_times(h_s, r));
  for (int i = 0; i < 4; i++) {
    const double pull = command_radps[i] - slope_at->rotor_radps[i];
    to.rotor_radps[i] = n->lag_s > 0.0 ? from->rotor_radps[i] + h_s / n->lag_s * pull : command_radps[i];
  }
  *force_b_N = w.force_b_N;
  return to;
}

// Keeps the vehicle standing level on the floor, and stops it at the ceiling.
static void stop(nature_flight_t *f) {
  const nature_t *const n = f->nature;
  nature_state_t *const s = &f->s;
  if (s->pos_m.z <= n->rest_m && s->vel_mps.z <= 0.0) {
    s->pos_m.z = n->rest_m;
    s->vel_mps = s->rate_radps = vec(0.0, 0.0, 0.0);
    s->q = turn_unit((turn_t){s->q.w, 0.0, 0.0, s->q.z});
    f->force_b_N = vec(0.0, 0.0, n->mass_kg * NATURE_G_MPS2);
  }
  if (s->pos_m.z >= n->ceiling_m && s->vel_mps.z > 0.0) s->vel_mps.z = 0.0;
}

void nature_start(nature_flight_t *f, const nature_t *n, vec_t pos_m) {
  memset(f, 0, sizeof *f);
  f->nature = n;
  f->s.pos_m = pos_m;
  f->s.q.w = 1.0;
  f->volt = n->sag_V;
  f->force_b_N = vec(0.0, 0.0, n->mass_kg * NATURE_G_MPS2);
  for (int i = 0; i < 4; i++) f->s.rotor_radps[i] = nature_hover_radps(n);
  for (int k = 0; k < NATURE_DELAY_MAX; k++)
    memcpy(f->late_radps[k], f->s.rotor_radps, sizeof f->late_radps[k]);
}

void nature_step(nature_flight_t *f, const double command_radps[4]) {
  const nature_t *const n = f->nature;
  const int late = (int)lround(n->delay_s / NATURE_STEP_S);
  double *const now = f->late_radps[f->steps % NATURE_DELAY_MAX];
  for (int i = 0; i < 4; i++) now[i] = fmin(fmax(command_radps[i], 0.0), n->most_radps);
  const double *const acts = f->late_radps[(f->steps + NATURE_DELAY_MAX - late) % NATURE_DELAY_MAX];
  const nature_state_t half = advanced(f, &f->s, &f->s, acts, 0.5 * NATURE_STEP_S, &f->force_b_N);
  f->s = advanced(f, &f->s, &half, acts, NATURE_STEP_S, &f->force_b_N);
  stop(f);
  if (n->strange_N != 0.0 && vec_length(strange_N(f, &f->s)) >= 0.5 * fabs(n->strange_N))
    f->felt_s += NATURE_STEP_S;
  f->steps++;
  f->t_s = f->steps * NATURE_STEP_S;
}
