// check.c - stage 1: checks that a flight's signals agree with physics and with each other.
#include "gap/1_read/read.h"

#include "base/constants.h"
#include "body/body.h"
#include "logs/log_sanity.h"

#include <math.h>
#include <stdio.h>

#define ABOVE_M     0.1 // an estimate of height may be wrong by as much
#define ABOVE_SHARE 0.1
#define MEAN_OF     50   // least number of samples for a mean
#define WINDOWS_MIN 6    // least number of windows for a slope with a standard error
#define CLEARLY     4.0  // standard errors
#define OTHER_SCALE 0.02 // as much as an effect of the right form misfits (CANDIDATES_MISFIT)
#define BLOCK_S     0.2  // over which commands are averaged: some kick at a set point's step, or chatter
#define FLIES_AT    0.3  // with more than this share of the largest block's thrust it flies
#define RANGE_M     0.02 // a range sensor reads more than this at least once
#define SHARE_MIN   0.65 // of the other motors' mean: outside, a column has another unit or half the commands
#define SHARE_MAX   1.5
#define FITS        (2 * COLUMNS_HINT + COLUMN_NAME_MAX) // bytes

static done_t check_acceleration(const gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  double sum = 0.0, up = 0.0;
  int n = 0, n_up = 0;
  if (!has(f->v, FORCE)) return DONE;
  for (int i = 0; i < f->n; i++) {
    const d3_t acc = vector_at(f->v, SIG_AX, i);
    const double size = d3_norm(acc);
    if (isnan(size)) continue;
    sum += size;
    n++;
    const double up_mps2 = has(f->v, ATTITUDE) ? dq_to_world(attitude_at(f->v, i), acc).z : (double)NAN;
    if (isnan(up_mps2)) continue;
    up += up_mps2;
    n_up++;
  }
  if (n >= MEAN_OF && !(sum / n >= LOG_ACC_MIN * G_MPS2 && sum / n <= LOG_ACC_MAX * G_MPS2))
    return log_refuse(rows, SIG_AZ, "mean |acceleration|", sum / n, LOG_ACC_MIN * G_MPS2,
                      LOG_ACC_MAX * G_MPS2, why);
  if (n_up >= MEAN_OF && f->n > 2.0 * f->rate_Hz && !(up / n_up >= 0.6 * G_MPS2 && up / n_up <= 1.4 * G_MPS2))
    return table_refuse(&rows->table, 0, rows->at[SIG_AZ], why,
                        "turned by the attitude, the mean specific force upwards is %.3g m/s2 over the whole "
                        "flight; allowed: 5.886 to 13.73 (wrong frame, sign or order of the attitude?)",
                        up / n_up);
  return DONE;
}

typedef struct {
  double n, gg, mg, mm, mean, moved_mean;
  double all_gg, all_mg; // over all windows
  // For a scale that is nearly right: sums with the mean difference (offset) removed, over the windows in
  // which the driver moves, in which the stream moves, and in which either does.
  double offset, driven_gg, driven_mg, moved_mg, moved_mm, left;
} slope_t;

// Returns the velocity that a bias or tilt of the accelerometer adds over a window, body axes; other drives:
// 0. In world axes it goes to and fro as the vehicle yaws, and would be taken for a movement.
static d3_t steady_b_mps(const gap_flight_t *f, const drive_t *drive) {
  const int m = gap_drive_samples(f, drive);
  d3_t sum = d3(0.0, 0.0, 0.0);
  double n = 0.0;
  for (int i = 0; drive == &GAP_PUSH && i + m < f->n; i += m) {
    window_t w;
    if (!gap_drive_window(f, drive, i, &w)) continue;
    const d3_t over = d3_sub(d3_of(w.driven), d3_of(w.moved));
    sum = d3_add(sum, dq_to_body(attitude_at(f->v, i + m / 2), over));
    n += 1.0;
  }
  return d3_scale(n > 0.0 ? 1.0 / n : 0.0, sum);
}

static bool window_at(const gap_flight_t *f, const drive_t *drive, int i, d3_t over_b_mps, window_t *w) {
  if (!gap_drive_window(f, drive, i, w)) return false;
  if (drive != &GAP_PUSH) return true;
  const int mid = i + gap_drive_samples(f, drive) / 2;
  d3_put(w->driven, d3_sub(d3_of(w->driven), dq_to_world(attitude_at(f->v, mid), over_b_mps)));
  return true;
}

// Returns the steady part that both means share, with one sign: of a vehicle that turns evenly all the time.
// Removed from the driver alone, it would make the stream move by a multiple of the driver's noise.
static double common(double a, double b) {
  return a * b > 0.0 ? copysign(fmin(fabs(a), fabs(b)), a) : 0.0;
}

// Sums for the slope of a stream against its driver, over the windows in which either of them moves.
static void slopes(const gap_flight_t *f, const drive_t *drive, slope_t slope[3]) {
  const int m = gap_drive_samples(f, drive);
  const d3_t steady_mps = steady_b_mps(f, drive);
  double n = 0.0;
  for (int pass = 0; pass < 2; pass++)
    for (int i = 0; i + m < f->n; i += m) {
      window_t w;
      if (!window_at(f, drive, i, steady_mps, &w)) continue;
      n += pass == 0;
      for (int k = 0; k < 3; k++) {
        // A constant offset of the sensor is no movement.
        if (pass == 0) slope[k].mean += (w.driven[k] - slope[k].mean) / n;
        if (pass == 0) slope[k].moved_mean += (w.moved[k] - slope[k].moved_mean) / n;
        if (pass == 0) slope[k].offset += (w.driven[k] - w.moved[k] - slope[k].offset) / n;
        const double g = w.driven[k] - slope[k].mean, moved = w.moved[k];
        const double beside = moved - common(slope[k].moved_mean, slope[k].mean);
        if (pass == 0) continue;
        slope[k].all_gg += g * g, slope[k].all_mg += beside * g;
        if (fabs(g) < drive->least && fabs(beside) < drive->least) continue;
        slope[k].n += 1.0;
        slope[k].gg += g * g, slope[k].mg += beside * g, slope[k].mm += beside * beside;
        const double d = w.driven[k] - slope[k].offset;
        if (fabs(d) >= drive->least) slope[k].driven_gg += d * d, slope[k].driven_mg += moved * d;
        if (fabs(moved) >= drive->least) slope[k].moved_mg += moved * d, slope[k].moved_mm += moved * moved;
        slope[k].left += (moved - d) * (moved - d);
      }
    }
}

// True if a line explains more than half of the squares.
static bool goes_along(const slope_t *s) {
  return s->mg * s->mg > 0.5 * s->mm * s->gg;
}

// True if the slope is sure to be out of bounds. Where the driver hardly moves, the windows in which the
// stream does are those in which its noise adds to that: over all windows the slope is no steeper than the
// true one.
static bool is_off(const slope_t *s) {
  const double b = s->mg / s->gg, error = CLEARLY * sqrt(fmax(0.0, s->mm - b * s->mg) / (s->n * s->gg));
  return b + error < SLOPE_MIN || (b - error > SLOPE_MAX && s->all_mg > SLOPE_MAX * s->all_gg);
}

// Writes what would fit, as the end of a message: another unit of either stream, or the other sign of one.
static void what_fits(const log_rows_t *rows, signal_id_t column, signal_id_t moved, const slope_t *s,
                      char text[FITS]) {
  const double b = s->mg / s->gg, size = fabs(b);
  char hint[COLUMNS_HINT];
  if (!goes_along(s)) return;
  if (b > 0.0) columns_hint(&rows->columns, column, 1.0, b / 2.0, b * 2.0, text);
  if (b > 0.0 && rows->at[moved] >= 0 && columns_hint(&rows->columns, moved, b, 0.5, 2.0, hint)[0])
    text_add(text, FITS, "%s of column %s %s", text[0] ? ", or" : ";", rows->columns.of[moved].column,
             hint + 2);
  if (b < 0.0 && size >= SLOPE_MIN && size <= SLOPE_MAX)
    snprintf(text, FITS, "; the other sign of one of both would fit (scale = -1 in a columns file)");
}

// Notes a scale that is slightly off, over all axes together. The driver's noise flattens the slope over the
// windows in which the driver moves; the stream's noise steepens it over those in which the stream moves. The
// truth lies between.
static void note_scale(gap_flight_t *f, const drive_t *drive, const slope_t slope[3]) {
  slope_t all = {.n = 0.0};
  for (int k = 0; k < 3; k++) {
    all.n += slope[k].n, all.left += slope[k].left;
    all.driven_gg += slope[k].driven_gg, all.driven_mg += slope[k].driven_mg;
    all.moved_mg += slope[k].moved_mg, all.moved_mm += slope[k].moved_mm;
  }
  if (all.n < WINDOWS_MIN || !(all.driven_mg > 0.0 && all.moved_mg > 0.0)) return;
  const double flat = all.driven_mg / all.driven_gg, steep = all.moved_mm / all.moved_mg;
  const double stderr_b = sqrt(all.left / (all.n * all.driven_gg));
  const double times = flat > 1.0 ? flat : fmin(steep, 1.0), off = fabs(times - 1.0);
  if (off > OTHER_SCALE && off > CLEARLY * stderr_b)
    gap_note(f,
             "the %s %s %.3f +- %.1g times as far as the %s says: one of them has another scale, and a name "
             "may be made of it",
             drive->what, drive->moves, times, stderr_b, drive->by);
}

static done_t check_drive(gap_flight_t *f, const log_rows_t *rows, const drive_t *drive, why_t *why) {
  slope_t slope[3] = {0};
  slopes(f, drive, slope);
  for (int k = 0; k < 3; k++) {
    const slope_t *const s = &slope[k];
    const signal_id_t column = (signal_id_t)((int)drive->driver + k);
    if (s->n < WINDOWS_MIN || !(s->gg > 0.0)) continue;
    if (!is_off(s)) continue;
    char text[FITS] = "";
    what_fits(rows, column, (signal_id_t)((int)drive->stream + k), s, text);
    return table_refuse(&rows->table, 0, rows->at[column], why,
                        "the %s %s %.3g times as far along axis %c as the %s says over the whole flight; "
                        "allowed: 0.33 to 3%s",
                        drive->what, drive->moves, s->mg / s->gg, 'x' + k, drive->by, text);
  }
  note_scale(f, drive, slope);
  return DONE;
}

// Refuses a range that is nearer throughout than any sensor sees: it has another unit. Readings that are too
// far are bad cells (log_rows.h).
static done_t check_range(const gap_flight_t *f, const log_rows_t *rows, signal_id_t i, why_t *why) {
  double most_m = 0.0;
  int n = 0;
  for (int j = 0; j < f->n && f->v[i]; j++) {
    if (isnan(f->v[i][j])) continue;
    most_m = fmax(most_m, f->v[i][j]);
    n++;
  }
  return n < MEAN_OF || most_m >= RANGE_M
             ? DONE
             : log_refuse(rows, i, "the largest range is", most_m, RANGE_M, 40.0, why);
}

// Returns the thrust by the rotors' speeds, or by the commands.
static double lift_N(const gap_flight_t *f, const model_t *vehicle, bool by_speeds, int i) {
  return by_speeds ? thrust_of_speeds_N(f->v, vehicle, i) : f->v[SIG_THRUST][i];
}

static int block_samples(const gap_flight_t *f) {
  return (int)fmax(1.0, round(BLOCK_S * f->rate_Hz));
}

// Means over those of a block's samples that have both; n: how many have, at least half of a block; 0: fewer,
// of which a kick would be the most.
typedef struct {
  int n;
  double thrust_N, acc_mps2;
} lift_t;

static lift_t lift_over(const gap_flight_t *f, const model_t *vehicle, bool by_speeds, int from) {
  const int end = from + block_samples(f) < f->n ? from + block_samples(f) : f->n;
  lift_t mean = {.n = 0};
  for (int i = from; i < end; i++) {
    const double thrust_N = lift_N(f, vehicle, by_speeds, i);
    const double acc_mps2 = has(f->v, FORCE) ? d3_norm(vector_at(f->v, SIG_AX, i)) : G_MPS2;
    if (!isfinite(thrust_N + acc_mps2)) continue;
    mean.n++;
    mean.thrust_N += (thrust_N - mean.thrust_N) / mean.n;
    mean.acc_mps2 += (acc_mps2 - mean.acc_mps2) / mean.n;
  }
  if (2 * mean.n < block_samples(f)) mean = (lift_t){.n = 0};
  return mean;
}

// Returns thrust over mass times specific force (g if not logged), both means in flight; NaN: too short.
static double lift_ratio(const gap_flight_t *f, const model_t *vehicle, bool by_speeds) {
  double most_N = 0.0, thrust = 0.0, takes = 0.0;
  int n = 0;
  for (int i = 0; i < f->n; i += block_samples(f))
    most_N = fmax(most_N, lift_over(f, vehicle, by_speeds, i).thrust_N);
  for (int i = 0; i < f->n; i += block_samples(f)) {
    const lift_t now = lift_over(f, vehicle, by_speeds, i);
    if (!(now.thrust_N > FLIES_AT * most_N) || !(now.acc_mps2 > 0.2 * G_MPS2)) continue;
    thrust += now.n * now.thrust_N;
    takes += now.n * vehicle->mass_kg * now.acc_mps2;
    n += now.n;
  }
  return n >= MEAN_OF ? thrust / takes : (double)NAN;
}

static done_t check_speeds(const gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  char text[COLUMNS_HINT];
  const double ratio = lift_ratio(f, &rows->vehicle, true);
  if (!(ratio < 0.2 || ratio > 5.0)) return DONE;
  return table_refuse(
      &rows->table, 0, rows->at[SIG_W1], why,
      "rotors of vehicle %s at these speeds give %.3g times what its acceleration takes; allowed: 0.2 to 5%s",
      rows->vehicle.name, ratio,
      columns_hint(&rows->columns, SIG_W1, sqrt(ratio), sqrt(0.2), sqrt(5.0), text));
}

// Adds up each motor over a block of samples, and returns the mean of their sum; n: samples that have all
// four. 0: these are less than half of a block.
static double sum_of_motors(const gap_flight_t *f, signal_id_t first, int from, double sum[ROTORS], int *n) {
  const int end = from + block_samples(f) < f->n ? from + block_samples(f) : f->n;
  double all = 0.0;
  for (int i = from; i < end; i++) {
    double now = 0.0;
    for (int k = 0; k < ROTORS; k++) now += f->v[(int)first + k][i];
    if (!isfinite(now)) continue;
    for (int k = 0; k < ROTORS; k++) sum[k] += f->v[(int)first + k][i];
    all += now;
    ++*n;
  }
  return 2 * *n < block_samples(f) ? 0.0 : all / *n;
}

// Refuses a motor whose mean in flight differs too much from the others': no trim is so uneven.
static done_t check_shares(const gap_flight_t *f, const log_rows_t *rows, signal_id_t first, why_t *why) {
  double most = 0.0, sum[ROTORS] = {0.0}, all = 0.0;
  int n = 0;
  for (int pass = 0; pass < 2; pass++)
    for (int i = 0; i < f->n; i += block_samples(f)) {
      double own[ROTORS] = {0.0};
      int here = 0;
      const double now = sum_of_motors(f, first, i, own, &here);
      if (pass == 0) most = fmax(most, now);
      if (pass == 0 || !(now > FLIES_AT * most)) continue;
      for (int k = 0; k < ROTORS; k++) sum[k] += own[k];
      all += here * now;
      n += here;
    }
  for (int k = 0; k < ROTORS && n >= MEAN_OF; k++) {
    const double share = (ROTORS - 1) * sum[k] / (all - sum[k]);
    if (share >= SHARE_MIN && share <= SHARE_MAX) continue;
    return table_refuse(&rows->table, 0, rows->at[(int)first + k], why,
                        "the mean is %.3g of the other motors' in flight; allowed: %g to %g", share,
                        SHARE_MIN, SHARE_MAX);
  }
  return DONE;
}

static done_t check_commands(const gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  const bool each = rows->at[SIG_M1] >= 0, pwm = each && rows->columns.motors == MOTORS_PWM;
  double most = 0.0;
  for (int k = 0; k < 4 && pwm && has(f->v, COMMANDS); k++)
    for (int i = 0; i < f->n; i++) most = fmax(most, f->v[SIG_M1 + k][i]);
  if (most > 0.0 && most <= 100.0)
    return log_refuse(rows, SIG_M1, "the largest motor command is", most, 1000.0, 65536.0, why);
  if (each && has(f->v, COMMANDS)) TRY(check_shares(f, rows, SIG_M1, why));
  if (!f->v[SIG_THRUST]) return DONE;
  const double ratio = lift_ratio(f, &rows->vehicle, false);
  if (!(ratio < SLOPE_MIN || ratio > SLOPE_MAX)) return DONE;
  const signal_id_t first = each ? SIG_M1 : SIG_THRUST;
  const double power =
      each && rows->columns.motors == MOTORS_RADPS ? 0.5 : 1.0; // thrust goes with its square
  char text[COLUMNS_HINT] = "";
  if (!pwm && !rows->columns.mixed_pwm)
    columns_hint(&rows->columns, first, pow(ratio, power), pow(SLOPE_MIN, power), pow(SLOPE_MAX, power),
                 text);
  return table_refuse(
      &rows->table, 0, rows->at[first], why,
      "commands to vehicle %s give %.3g times what its acceleration takes; allowed: 0.33 to 3 "
      "(is it the right vehicle and unit?)%s",
      rows->vehicle.name, ratio, text);
}

// Refuses heights above the ceiling: of another room, or counted from another floor.
static done_t check_ceiling(const gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  const model_t *m = &rows->vehicle;
  const double rotors_m = body_rest_z_m(m) + body_rotor_z_m(m);
  double most_m = 0.0;
  int n = 0, above = 0;
  for (int i = 0; i < f->n; i++) {
    const double over_m = f->v[SIG_Z][i] + rotors_m - m->ceiling_m;
    if (isnan(over_m)) continue;
    n++;
    above += over_m > ABOVE_M;
    most_m = fmax(most_m, over_m);
  }
  if (n < MEAN_OF || above <= ABOVE_SHARE * n) return DONE;
  char from[80] = "";
  if (f->floor_m != 0.0)
    snprintf(from, sizeof from, "; heights count from %.3g m, where it stood before take-off", f->floor_m);
  return table_refuse(&rows->table, 0, rows->at[SIG_Z], why,
                      "up to %.2g m above the ceiling of vehicle %s (ceiling_m = %g%s); allowed: below it",
                      most_m, m->name, m->ceiling_m, from);
}

done_t gap_check(gap_flight_t *f, const log_rows_t *rows, why_t *why) {
  static const drive_t *const drives[] = {&GAP_TURN, &GAP_GO, &GAP_PUSH};
  TRY(check_acceleration(f, rows, why));
  for (int i = 0; i < 3; i++)
    if (has(f->v, drives[i]->need)) TRY(check_drive(f, rows, drives[i], why));
  if (f->v[SIG_Z] && isfinite(rows->vehicle.ceiling_m)) TRY(check_ceiling(f, rows, why));
  TRY(check_range(f, rows, SIG_RANGE, why));
  TRY(check_range(f, rows, SIG_RANGE_DOWN, why));
  TRY(gap_check_moves(f, rows, why));
  TRY(check_commands(f, rows, why));
  if (!has(f->v, SPEEDS)) return DONE;
  TRY(check_shares(f, rows, SIG_W1, why));
  return check_speeds(f, rows, why);
}
