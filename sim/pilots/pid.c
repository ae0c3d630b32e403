// pid.c - PID on height, with feed-forward.
#include "pilots/pid.h"

#include "base/clip.h"

static double believed_ratio(const pid_param_t *p, double z_m) {
  const double k = p->radius_m / (4.0 * (p->ceiling_m - z_m));
  const double denominator = 1.0 - k * k;
  return denominator > 1.0 / p->ratio_max ? 1.0 / denominator : p->ratio_max;
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  pid_peer_t *s = state;
  const pid_param_t *p = &s->param;
  const double z_m = in->pos_w_m.z, error = in->set.pos_w_m.z - z_m;
  const double rate = p->n_per_s * (p->d * error - s->slow_error);
  const double wanted_N = clip(p->p * error + s->integral + rate, -p->limit_N, p->limit_N);
  s->integral += s->period_s * p->i * error;
  s->slow_error += s->period_s * rate;

  s->ratio = p->feed_forward ? believed_ratio(p, z_m) : 1.0;
  const double thrust_N = wanted_N + p->hover_N - (s->ratio - 1.0) * in->rotors_N;
  for (int i = 0; i < PILOT_MOTORS; i++) motor_N[i] = thrust_N / PILOT_MOTORS;
}

static void reset(void *state) {
  pid_peer_t *s = state;
  s->integral = s->slow_error = 0.0;
}

static void tell(const void *state, thoughts_t *thoughts) {
  thoughts->ratio = ((const pid_peer_t *)state)->ratio;
}

pilot_t pid_pilot(pid_peer_t *pid, const pid_param_t *param, double period_s) {
  *pid = (pid_peer_t){.param = *param, .period_s = period_s, .ratio = 1.0};
  return (pilot_t){.state = pid, .step = step, .reset = reset, .tell = tell};
}
