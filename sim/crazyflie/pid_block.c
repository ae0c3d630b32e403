// pid_block.c - one PID of the Crazyflie's firmware.
#include "crazyflie/pid_block.h"

#include "base/clip.h"

// Wraps by one turn at most, as the firmware does: enough for angles of -180..180.
static double short_way(double angle_deg, bool degrees) {
  if (degrees && angle_deg > 180.0) return angle_deg - 360.0;
  if (degrees && angle_deg < -180.0) return angle_deg + 360.0;
  return angle_deg;
}

void pid_block_start(pid_block_t *s, const pid_gain_t *p, double rate_Hz, double measured) {
  *s = (pid_block_t){.measured_last = measured};
  if (p->cutoff_Hz > 0.0) lowpass_init(&s->slope, p->cutoff_Hz, rate_Hz, 0.0);
}

void pid_block_reset(pid_block_t *s, double measured) {
  s->integral = 0.0;
  s->measured_last = measured;
}

double pid_block_step(pid_block_t *s, const pid_gain_t *p, double rate_Hz, double wanted, double measured,
                      bool degrees) {
  const double error = short_way(wanted - measured, degrees);
  const double fall = rate_Hz * short_way(s->measured_last - measured, degrees);
  const double slope = p->cutoff_Hz > 0.0 ? lowpass_step(&s->slope, fall) : fall;
  s->measured_last = measured;
  s->integral = clip(s->integral + error / rate_Hz, -p->integral_max, p->integral_max);
  const double output = p->kp * error + p->ki * s->integral + p->kd * slope;
  return p->output_max > 0.0 ? clip(output, -p->output_max, p->output_max) : output;
}
