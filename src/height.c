// height.c - height and climb from thrust, accelerometer and downward range sensor.
#include "flight/height.h"

#include "flight/bounds.h"

// Each of these constants, and of the header's, is pinned by a row of
// the_height_filters_numbers_are_what_it_does.
#define ACC_DELAY_S  0.0075f // of the accelerometer's filter, as in the header
#define FADE_S       0.25f   // from one height to the other: over ten ticks of the outer loop, so no step
#define MEAN_S       0.25f   // averaging time of the mean squares: a knock passes, a contact does not
#define DOWN_S       0.025f  // from a range sample to the next
#define CURVE_NEAR_M 0.005f  // over this distance the curve is a straight line
#define RANGE_MAX_M  2.0f    // beyond, the range sensor's noise grows
#define CONE_SIN     0.1305f // of half the downward sensor's view, 7.5 degrees
#define CONE_COS     sqrtf(1.0f - CONE_SIN * CONE_SIN)
#define WILD_ROW     3 // one rejected sample is a speck, this many in a row are another floor
// Initial variances: of the estimator's errors, and of what is not known yet.
#define BEGIN_H_VAR 1e-5f // 3 mm
#define BEGIN_W_VAR 1e-3f // 3 cm/s
#define BEGIN_D_VAR 0.25f // 0.5 m/s2: a thrust map that is 5 % wrong
#define BEGIN_B_VAR 4e-3f // 0.06 m/s2: what a calibration on the floor leaves

// Restarts from the estimator, with its variances. A known bias is kept, and what is flown fades out.
static void begin(height_t *s, const height_in_t *in) {
  const float bias_mps2 = s->started ? s->x[HEIGHT_B] : in->bias_mps2;
  *s = (height_t){
      .x = {in->z_m - s->off_m, in->climb_mps, 0.0f, f_bound(bias_mps2, HEIGHT_BIAS_MAX)},
      .P = {{BEGIN_H_VAR}, {0.0f, BEGIN_W_VAR}, {0.0f, 0.0f, BEGIN_D_VAR}, {0.0f, 0.0f, 0.0f, BEGIN_B_VAR}},
      .off_m = s->off_m,
      .thrust_N = in->thrust_N,
      .sent_N = {in->thrust_N, in->thrust_N, in->thrust_N},
      .acc_odd = 1.0f,
      .down_odd = 1.0f,
      .wait = s->wait,
      .share = s->share,
      .more_m = s->more_m,
      .more_mps = s->more_mps,
      .started = true};
}

static bool usable(const height_in_t *in) {
  return v3_within(in->acc_b_mps2, BOUND_ACC_MPS2) && fabsf(in->z_m) <= BOUND_POS_M &&
         fabsf(in->climb_mps) <= BOUND_VEL_MPS && fabsf(in->thrust_N) <= BOUND_THRUST_N &&
         quat_plausible(in->q_wb) && in->mass_kg > 0.0f;
}

// Advances the motors by a period. Because of the command's delay, they received partly this command, partly
// those before.
static void turn_motors(height_t *s, float delay_s, float motor_share, float thrust_N) {
  const float late = (HEIGHT_COMMAND_S + delay_s) / HEIGHT_S;
  const int whole = late < 1.0f ? 0 : late < 2.0f ? 1 : 2;
  const float newer_N = whole == 0 ? thrust_N : s->sent_N[whole - 1];
  const float sent_N = newer_N + (late - (float)whole) * (s->sent_N[whole] - newer_N);
  s->sent_N[2] = s->sent_N[1];
  s->sent_N[1] = s->sent_N[0];
  s->sent_N[0] = thrust_N;
  s->thrust_N += motor_share * (sent_N - s->thrust_N);
}

// Returns the thrust ratio where the vehicle will be after the step. Where the curve does not fall it is not
// a ceiling's (the fitted bells rise again from 8 cm on), and the ground's share alone remains.
static float ratio_at(const height_t *s, const height_in_t *in) {
  if (!(in->at.slope_per_m < 0.0f) || !f_finite(in->ceiling_z_m)) return 1.0f + in->ground_excess;
  const float zc_m = in->ceiling_z_m - (s->x[HEIGHT_H] + s->off_m + HEIGHT_S * s->x[HEIGHT_W]);
  return in->at.ratio + in->at.slope_per_m * f_bound(zc_m - in->zc_m, CURVE_NEAR_M);
}

// Predicts state and covariance one step later, at the acceleration acc_mps2.
static void predict(height_t *s, const height_param_t *p, float acc_mps2, float k_per_s2) {
  const float mean_mps2 = 0.5f * (s->acc_mps2 + acc_mps2), kdt = HEIGHT_S * k_per_s2;
  s->x[HEIGHT_H] += HEIGHT_S * (s->x[HEIGHT_W] + 0.5f * HEIGHT_S * mean_mps2);
  s->x[HEIGHT_W] += HEIGHT_S * mean_mps2;
  float(*const P)[HEIGHT_N] = s->P;
  for (int j = 0; j < HEIGHT_N; j++) {
    const float h = P[HEIGHT_H][j], w = P[HEIGHT_W][j];
    P[HEIGHT_H][j] = h + HEIGHT_S * w;
    P[HEIGHT_W][j] = w + kdt * h + HEIGHT_S * P[HEIGHT_D][j];
  }
  for (int i = 0; i < HEIGHT_N; i++) {
    const float h = P[i][HEIGHT_H], w = P[i][HEIGHT_W];
    P[i][HEIGHT_H] = h + HEIGHT_S * w;
    P[i][HEIGHT_W] = w + kdt * h + HEIGHT_S * P[i][HEIGHT_D];
  }
  for (int i = 1; i < HEIGHT_N; i++) // symmetric to the bit
    for (int j = 0; j < i; j++) P[j][i] = P[i][j];
  P[HEIGHT_W][HEIGHT_W] += HEIGHT_S * HEIGHT_CLIMB_WALK * HEIGHT_CLIMB_WALK;
  P[HEIGHT_D][HEIGHT_D] += HEIGHT_S * p->walk_mps2 * p->walk_mps2;
  P[HEIGHT_B][HEIGHT_B] += HEIGHT_S * HEIGHT_BIAS_WALK * HEIGHT_BIAS_WALK;
}

// Takes one measurement: x += K e, P -= K H' P, where PH is P H and var is H' P H + R.
static void take(height_t *s, const float PH[HEIGHT_N], float var, float e) {
  const float per_var = 1.0f / var;
  for (int i = 0; i < HEIGHT_N; i++) {
    const float K = PH[i] * per_var;
    s->x[i] += K * e;
    for (int j = 0; j <= i; j++) s->P[i][j] = s->P[j][i] = s->P[i][j] - K * PH[j];
  }
}

static void take_acc(height_t *s, float e_mps2, float k_per_s2) {
  float PH[HEIGHT_N];
  for (int i = 0; i < HEIGHT_N; i++)
    PH[i] = k_per_s2 * s->P[i][HEIGHT_H] + s->P[i][HEIGHT_D] + s->P[i][HEIGHT_B];
  const float var = k_per_s2 * PH[HEIGHT_H] + PH[HEIGHT_D] + PH[HEIGHT_B] + HEIGHT_ACC_VAR;
  const float odd = e_mps2 * e_mps2 / var;
  s->acc_odd += HEIGHT_S / MEAN_S * (f_min(odd, HEIGHT_WILD) - s->acc_odd);
  take(s, PH, var, e_mps2);
}

// Returns height over slant range, by the firmware's model: the sensor sees the nearest point in its cone.
static float slant(float up) {
  if (up >= CONE_COS) return 1.0f;
  return up * CONE_COS + sqrtf(f_max(1.0f - up * up, 0.0f)) * CONE_SIN;
}

static void take_down(height_t *s, float down_m, float acc_mps2) {
  s->silent = 0;
  s->same = EITHER(down_m != s->down_last_m, 0, EITHER(s->same < HEIGHT_SAME, s->same + 1, HEIGHT_SAME));
  s->down_last_m = down_m;
  const float then_m =
      s->x[HEIGHT_H] - HEIGHT_DOWN_AGE_S * (s->x[HEIGHT_W] - 0.5f * HEIGHT_DOWN_AGE_S * acc_mps2);
  const float e_m = down_m - then_m;
  float PH[HEIGHT_N];
  for (int i = 0; i < HEIGHT_N; i++) PH[i] = s->P[i][HEIGHT_H];
  const float var = PH[HEIGHT_H] + HEIGHT_DOWN_VAR, odd = e_m * e_m / var;
  s->down_odd += DOWN_S / MEAN_S * (f_min(odd, HEIGHT_WILD) - s->down_odd);
  if (!(odd < HEIGHT_WILD)) {
    s->wild++;
    return;
  }
  s->wild = 0;
  take(s, PH, var, e_m);
}

static void follow(height_t *s, float z_m) {
  const int most = HEIGHT_OFF_STEPS;
  s->off_steps = s->off_steps < most ? s->off_steps + 1 : most;
  s->off_m += (z_m - s->x[HEIGHT_H] - s->off_m) / (float)s->off_steps;
}

static bool is_state(const height_t *s) {
  for (int i = 0; i < HEIGHT_N; i++)
    if (!(s->P[i][i] >= 0.0f && f_finite(s->P[i][i]))) return false;
  return fabsf(s->x[HEIGHT_H]) <= 2.0f * BOUND_POS_M && fabsf(s->x[HEIGHT_W]) <= BOUND_VEL_MPS &&
         fabsf(s->x[HEIGHT_D]) <= HEIGHT_FORCE_MAX && fabsf(s->x[HEIGHT_B]) <= HEIGHT_BIAS_MAX &&
         fabsf(s->off_m) <= 2.0f * BOUND_POS_M && fabsf(s->thrust_N) <= BOUND_THRUST_N;
}

static bool fits(const height_t *s, const height_in_t *in) {
  return s->acc_odd < HEIGHT_ODD && s->down_odd < HEIGHT_ODD && s->wild < WILD_ROW &&
         s->silent < HEIGHT_SILENT && s->same < HEIGHT_SAME &&
         fabsf(s->x[HEIGHT_H] + s->off_m - in->z_m) <= HEIGHT_APART_M &&
         fabsf(s->x[HEIGHT_W] - in->climb_mps) <= HEIGHT_APART_MPS;
}

// Returns `wait` within its bounds, as a bit of it may have flipped.
static int within(int wait) {
  return EITHER(wait < HEIGHT_FIT, HEIGHT_FIT, EITHER(wait > HEIGHT_FIT_MAX, HEIGHT_FIT_MAX, wait));
}

static bool is_flown(const height_t *s) {
  return s->fit >= within(s->wait);
}

// Counts one more step that fits, or one that does not.
static void judge(height_t *s, bool good) {
  s->wait = within(s->wait);
  if (s->fit >= HEIGHT_TRUST * s->wait) s->fit = s->wait = within(s->wait / 2);
  if (!good && is_flown(s)) s->wait = within(2 * s->wait);
  s->fit = EITHER(good, s->fit + 1, 0);
}

void height_step(height_t *s, const height_param_t *p, float motor_share, const height_in_t *in) {
  const float to = is_flown(s) ? 1.0f : 0.0f;
  const float share = s->share + f_clamp(to - s->share, -HEIGHT_S / FADE_S, HEIGHT_S / FADE_S);
  s->share = f_clamp(share, 0.0f, 1.0f); // a bit of it may have flipped, too
  if (!usable(in)) {
    height_lose(s);
    return;
  }
  if (!s->started) begin(s, in);
  turn_motors(s, p->delay_s, motor_share, in->thrust_N);
  const float up = quat_up(in->q_wb).z, ratio = ratio_at(s, in);
  const float k_per_s2 = ratio > 1.0f ? -GRAVITY_MPS2 * in->at.slope_per_m / ratio : 0.0f;
  const float acc_mps2 = ratio * s->thrust_N * up / in->mass_kg - GRAVITY_MPS2 + s->x[HEIGHT_D];
  const float e_mps2 = quat_to_world(in->q_wb, in->acc_b_mps2).z - GRAVITY_MPS2 - s->x[HEIGHT_B] -
                       (acc_mps2 + ACC_DELAY_S / HEIGHT_S * (s->acc_mps2 - acc_mps2));
  const float before_mps2 = s->x[HEIGHT_D];
  predict(s, p, acc_mps2, k_per_s2);
  take_acc(s, e_mps2, k_per_s2);
  if (s->silent < HEIGHT_SILENT) s->silent++;
  if (in->down_m > 0.0f && in->down_m <= RANGE_MAX_M) take_down(s, in->down_m * slant(up), acc_mps2);
  s->acc_mps2 = acc_mps2 + s->x[HEIGHT_D] - before_mps2;
  follow(s, in->z_m);
  const bool state = is_state(s), good = state && fits(s, in) && p->own != 0;
  judge(s, good);
  if (!state) s->off_m = 0.0f;
  if (!good) begin(s, in);
}

void height_fly(height_t *s, const height_param_t *p, const pos_indi_param_t *law, float z_m, float climb_mps,
                height_fly_t *fly) {
  if (is_flown(s)) {
    const float h_m =
        s->x[HEIGHT_H] + HEIGHT_AHEAD_S * (s->x[HEIGHT_W] + 0.5f * HEIGHT_AHEAD_S * s->acc_mps2);
    s->more_m = f_bound(h_m + s->off_m - z_m, HEIGHT_APART_M);
    s->more_mps = f_bound(s->x[HEIGHT_W] + HEIGHT_AHEAD_S * s->acc_mps2 - climb_mps, HEIGHT_APART_MPS);
  }
  const float share = f_clamp(s->share, 0.0f, 1.0f);
  fly->more_m = share * f_bound(s->more_m, HEIGHT_APART_M);
  fly->more_mps = share * f_bound(s->more_mps, HEIGHT_APART_MPS);
  fly->law = *law;
  fly->law.kp_z_per_s += share * (p->kp_per_s - law->kp_z_per_s);
  fly->law.kd_z_per_s += share * (p->kd_per_s - law->kd_z_per_s);
  fly->law.quick += share * (p->quick - law->quick);
  fly->law.catch_s += share * (p->catch_s - law->catch_s);
}
