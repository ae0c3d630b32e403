// pid.c - PID on height, with feed-forward.
#include "pilots/pid.h"

#include "base/clip.h"

static double believed_ratio(const pid_param_t *p, double z_m) {
  const double k = p->radius_m / (4.0 * (p->ceiling_m - z_m));
  const double denominator = 1.0 - k * k;
  return denominator > 1.0 / p->ratio_max ? 1.0 / denominator : p->ratio_max;
}

static double step(void *state, const sense_t *in, thoughts_t *thoughts) {
  pid_peer_t *s = state;
  const pid_param_t *p = &s->param;
  const double error = in->setpoint_m - in->z_m;
  const double rate = p->n_per_s * (p->d * error - s->slow_error);
  const double wanted_N = clip(p->p * error + s->integral + rate, -p->limit_N, p->limit_N);
  s->integral += s->period_s * p->i * error;
  s->slow_error += s->period_s * rate;

  thoughts->ratio = p->feed_forward ? believed_ratio(p, in->z_m) : 1.0;
  return wanted_N + p->hover_N - (thoughts->ratio - 1.0) * in->motor_N;
}

controller_t pid_controller(pid_peer_t *pid, const pid_param_t *param, double period_s) {
  *pid = (pid_peer_t){.param = *param, .period_s = period_s};
  return (controller_t){.state = pid, .period_s = period_s, .step = step};
}
