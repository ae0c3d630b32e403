// log_sanity.c - does a whole flight agree with physics and with itself?
#include "logs/log_sanity.h"

#include "base/constants.h"
#include <math.h>

#define ENOUGH 50 // rows from which a mean says something

void log_sanity_add(log_sanity_t *s, const log_row_t *row) {
  const double *v = row->v, t_s = v[SIG_TIME];
  const double dt_s = t_s - s->last_s, dz_m = v[SIG_Z] - s->last_z_m;
  if (s->rows++ == 0) {
    s->first_s = t_s;
  } else if (dt_s <= LOG_GAP_S && isfinite(v[SIG_VZ]) && isfinite(dz_m)) {
    s->climb2 += v[SIG_VZ] * v[SIG_VZ] * dt_s;
    s->climb_by_z += v[SIG_VZ] * dz_m;
  }
  s->last_s = t_s;
  s->last_z_m = v[SIG_Z];
  const double acc_mps2 = sqrt(v[SIG_AX] * v[SIG_AX] + v[SIG_AY] * v[SIG_AY] + v[SIG_AZ] * v[SIG_AZ]);
  if (isfinite(acc_mps2)) {
    s->acc_sum_mps2 += acc_mps2;
    s->acc_rows++;
  }
  for (int i = SIG_M1; i <= SIG_M4; i++) s->command_max = v[i] > s->command_max ? v[i] : s->command_max;
}

done_t log_refuse(const log_rows_t *rows, signal_id_t i, const char *what, double value, double min,
                  double max, why_t *why) {
  char hint[COLUMNS_HINT];
  const char *const si = columns_si(&rows->columns, i);
  return table_refuse(&rows->table, 0, rows->at[i], why,
                      "%s %.3g %s over the whole flight; allowed: %.4g to %.4g %s%s", what, value, si, min,
                      max, si, columns_hint(&rows->columns, i, value, min, max, hint));
}

static done_t check_acc(const log_sanity_t *s, const log_rows_t *rows, why_t *why) {
  if (s->acc_rows < ENOUGH) return DONE;
  const double acc_mps2 = s->acc_sum_mps2 / (double)s->acc_rows;
  if (acc_mps2 >= LOG_ACC_MIN * G_MPS2 && acc_mps2 <= LOG_ACC_MAX * G_MPS2) return DONE;
  return log_refuse(rows, SIG_AZ, "mean |acceleration|", acc_mps2, LOG_ACC_MIN * G_MPS2, LOG_ACC_MAX * G_MPS2,
                    why);
}

static done_t check_climb(const log_sanity_t *s, const log_rows_t *rows, why_t *why) {
  const double span_s = s->last_s - s->first_s;
  if (s->rows < ENOUGH || !(s->climb2 > 0.02 * 0.02 * span_s)) return DONE;
  const double share = s->climb_by_z / s->climb2;
  // Noise and slow estimators change the share, but neither its sign nor by an order of magnitude.
  if (share >= 0.05 && share <= 20.0) return DONE;
  return table_refuse(&rows->table, 0, rows->at[SIG_Z], why,
                      "moves %.3g times as far as column %s says over the whole flight; allowed: 0.05 to 20",
                      share, rows->columns.of[SIG_VZ].column);
}

done_t log_sanity_check(const log_sanity_t *s, const log_rows_t *rows, why_t *why) {
  const double apart_s = s->rows > 1 ? (s->last_s - s->first_s) / (double)(s->rows - 1) : 0.01;
  if (!(apart_s >= 1e-4 && apart_s <= LOG_GAP_S))
    return log_refuse(rows, SIG_TIME, "rows are apart by", apart_s, 1e-4, LOG_GAP_S, why);
  TRY(check_acc(s, rows, why));
  TRY(check_climb(s, rows, why));
  const bool commands = rows->at[SIG_M1] >= 0 && rows->columns.motors == MOTORS_PWM;
  if (commands && s->rows >= ENOUGH && s->command_max > 0.0 && s->command_max <= 100.0)
    return log_refuse(rows, SIG_M1, "the largest motor command is", s->command_max, 1000.0, 65536.0, why);
  return DONE;
}
