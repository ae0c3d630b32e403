// user.c - what a user of the second plant draws, and the files that they write of it.
#include "exam/other/flight.h"

other_job_t other_job(dice_t *d) {
  other_job_t job = {.known = hide_vehicle(d), .briskness = dice_between(d, 0.85, 1.1)};
  const double noise = dice_between(d, 0.5, 2.0);
  if (dice_share(d) < 0.4) job.known.ceiling_m = 0.85 * hide_stretch(&job.known) + 6.0 * job.known.radius_m;
  if (dice_share(d) < 0.5) job.known.delay_s = 0.002 * floor(dice_between(d, 0.0, 3.999));
  job.senses = (senses_t){.acc_mps2 = 0.3 * noise,
                          .gyro_radps = 0.01 * noise,
                          .place_m = 0.002 * noise,
                          .angle_rad = 0.004 * noise,
                          .volt = 0.008,
                          .range_m = 0.006,
                          .acc_pole_Hz = dice_between(d, 30.0, 60.0),
                          .gyro_pole_Hz = dice_between(d, 60.0, 100.0)};
  static const int every[] = {5, 5, 5, 2, 10, 1}; // 100 Hz most often
  job.habits = (habits_t){every[(int)dice_between(d, 0.0, 5.999)], dice_share(d) < 0.4,
                          dice_share(d) < 0.3 ? 0.004 : 0.0, (command_unit_t)dice_between(d, 0.0, 2.999)};
  return job;
}

void other_write_columns(const other_job_t *job, FILE *out) {
  static const char *const unit[] = {"rad/s", "share", "N"};
  const double acc_ms = 1e3 * senses_late_s(job->senses.acc_pole_Hz);
  const double gyro_ms = 1e3 * senses_late_s(job->senses.gyro_pole_Hz);
  static const char *const plain[][3] = {
      {"time", "t", "s"},   {"x", "px", "m"},     {"y", "py", "m"},     {"z", "pz", "m"},
      {"vx", "vx", "m/s"},  {"vy", "vy", "m/s"},  {"vz", "vz", "m/s"},  {"qw", "qw", "1"},
      {"qx", "qx", "1"},    {"qy", "qy", "1"},    {"qz", "qz", "1"},    {"vbat", "volt", "V"},
      {"set_x", "sx", "m"}, {"set_y", "sy", "m"}, {"set_z", "sz", "m"}, {"set_yaw", "syaw", "rad"}};
  fprintf(out, "# Rows at %g Hz, %s.\n", 1.0 / (PILOT_S * job->habits.every),
          job->habits.means ? "means over their period" : "instants");
  fprintf(out, "rest_height_m = %.7g\nacceleration = \"body\"\n\n[columns]\n", job->known.rest_m);
  for (unsigned i = 0; i < sizeof plain / sizeof *plain; i++)
    fprintf(out, "%s = {column = \"%s\", unit = \"%s\"}\n", plain[i][0], plain[i][1], plain[i][2]);
  for (int k = 0; k < 3; k++)
    fprintf(out,
            "a%c = {column = \"a%c\", unit = \"m/s2\", late_ms = %.4g}\ng%c = {column = \"%c\", unit = "
            "\"rad/s\", late_ms = %.4g}\n",
            'x' + k, 'x' + k, acc_ms, 'x' + k, 'p' + k, gyro_ms);
  for (int i = 1; i <= 4; i++)
    fprintf(out, "m%d = {column = \"cmd%d\", unit = \"%s\", late_ms = %.4g}\n", i, i, unit[job->habits.unit],
            1e3 * job->habits.late_s);
  // A sample is at the beginning of its row's period, the rest of a mean row at its middle.
  const double age_ms = job->habits.means ? 0.5e3 * PILOT_S * job->habits.every : 0.0;
  if (job->known.ceiling_m < 1e3)
    fprintf(out, "range = {column = \"up\", unit = \"m\", late_ms = %.4g}\n", age_ms);
}

static void list(FILE *out, const char *key, const double *v, int n) {
  fprintf(out, "%s = [", key);
  for (int i = 0; i < n; i++) fprintf(out, "%s%.7g", i ? ", " : "", v[i]);
  fprintf(out, "]\n");
}

static void write_map(const other_job_t *job, FILE *out) {
  const nature_t *const n = &job->known;
  const double most_N = n->k_Ns2 * n->most_radps * n->most_radps;
  if (job->habits.unit == COMMAND_SPEED)
    fprintf(out, "\n[thrust_map]\nkind = \"speed\"\nc = [0.0, 0.0, %.7g]\n", n->k_Ns2);
  if (job->habits.unit == COMMAND_SHARE)
    fprintf(out, "\n[thrust_map]\nkind = \"pwm_cubic\"\nc = [0.0, 0.0, %.7g, 0.0]\n", most_N);
}

void other_write_vehicle(const other_job_t *job, FILE *out) {
  const nature_t *const n = &job->known;
  fprintf(out, "name = \"a simulator's quadrotor\"\nmass_kg = %.7g\nrotor_radius_m = %.7g\n", n->mass_kg,
          n->radius_m);
  fprintf(out, "motor_tau_s = %.7g # of the rotors' speed\nthrust_min_N = 0.0\n", fmax(n->lag_s, 0.001));
  fprintf(out, "thrust_max_N = %.7g\n", 4.0 * n->k_Ns2 * n->most_radps * n->most_radps);
  if (n->ceiling_m < 1e3) fprintf(out, "ceiling_m = %.7g\n", n->ceiling_m);
  write_map(job, out);
  fprintf(out, "\n[body]\n");
  list(out, "inertia_kgm2", n->inertia_kgm2, 3);
  fprintf(out, "cg_above_feet_m = %.7g\nrotor_above_feet_m = %.7g\ntop_above_rotor_m = 0.0\n\n[rotors]\n",
          n->rest_m, n->rest_m);
  list(out, "x_m", n->x_m, 4);
  list(out, "y_m", n->y_m, 4);
  list(out, "spin", n->spin, 4);
  fprintf(out, "torque_ratio_m = %.7g\nkf_Ns2 = %.7g\ninertia_kgm2 = 0.0\ndelay_s = %.7g\n", n->torque_m,
          n->k_Ns2, n->delay_s);
  if (n->hub_kg > 0.0) fprintf(out, "\n[[effect]]\nname = \"rotor_drag\"\nk = %.7g\n", n->hub_kg);
  if (n->climb_kg > 0.0) fprintf(out, "\n[[effect]]\nname = \"climb_inflow\"\nk = %.7g\n", n->climb_kg);
}
