// user.c - draws a user of the second plant, and writes the files that this user would write.
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
  job.habits = (habits_t){.every = every[(int)dice_between(d, 0.0, 5.999)], .means = dice_share(d) < 0.4};
  job.habits.late_s = dice_share(d) < 0.3 ? 0.004 : 0.0;
  job.habits.unit = (command_unit_t)dice_between(d, 0.0, 2.999);
  return job;
}

// The log's columns: signal, name, unit, the stream it belongs to, the sensor whose delay it has.
typedef enum { LATE_NOT, LATE_ACC, LATE_GYRO } late_t;
static const struct {
  const char *signal, *name, *unit;
  unsigned lacks;
  late_t late;
} COLUMN[] = {
    {"time", "t", "s", 0u, LATE_NOT},
    {"x", "px", "m", 0u, LATE_NOT},
    {"y", "py", "m", 0u, LATE_NOT},
    {"z", "pz", "m", 0u, LATE_NOT},
    {"vx", "vx", "m/s", LACKS_SPEED, LATE_NOT},
    {"vy", "vy", "m/s", LACKS_SPEED, LATE_NOT},
    {"vz", "vz", "m/s", LACKS_SPEED, LATE_NOT},
    {"qw", "qw", "1", 0u, LATE_NOT},
    {"qx", "qx", "1", 0u, LATE_NOT},
    {"qy", "qy", "1", 0u, LATE_NOT},
    {"qz", "qz", "1", 0u, LATE_NOT},
    {"ax", "ax", "m/s2", LACKS_ACC, LATE_ACC},
    {"ay", "ay", "m/s2", LACKS_ACC, LATE_ACC},
    {"az", "az", "m/s2", LACKS_ACC, LATE_ACC},
    {"gx", "p", "rad/s", 0u, LATE_GYRO},
    {"gy", "q", "rad/s", 0u, LATE_GYRO},
    {"gz", "r", "rad/s", 0u, LATE_GYRO},
    {"vbat", "volt", "V", LACKS_VOLT, LATE_NOT},
    {"set_x", "sx", "m", LACKS_WISH, LATE_NOT},
    {"set_y", "sy", "m", LACKS_WISH, LATE_NOT},
    {"set_z", "sz", "m", LACKS_WISH, LATE_NOT},
    {"set_yaw", "syaw", "rad", LACKS_WISH, LATE_NOT},
};

static void motor_columns(const habits_t *h, FILE *out) {
  static const char *const unit[] = {"rad/s", "share", "N"};
  for (int i = 1; i <= 4; i++) {
    const int of = h->dirt == DIRT_EXCHANGED && i <= 2 ? 3 - i : i;
    fprintf(out, "m%d = {column = \"cmd%d\", unit = \"%s\", late_ms = %.4g}\n", i, of, unit[h->unit],
            1e3 * h->late_s);
  }
}

void other_write_columns(const other_job_t *job, FILE *out) {
  const habits_t *const h = &job->habits;
  const double late_ms[] = {0.0, 1e3 * senses_late_s(job->senses.acc_pole_Hz),
                            1e3 * senses_late_s(job->senses.gyro_pole_Hz)};
  const double row_ms = 1e3 * PILOT_S * h->every;
  fprintf(out, "# Rows at %g Hz.\nrows = \"%s\"\n", 1e3 / row_ms, h->means ? "means" : "instants");
  fprintf(out, "rest_height_m = %.7g\n%s\n[columns]\n", job->known.rest_m,
          h->lacks & LACKS_ACC ? "" : "acceleration = \"body\"\n");
  for (unsigned i = 0; i < sizeof COLUMN / sizeof *COLUMN; i++)
    if (!(h->lacks & COLUMN[i].lacks))
      fprintf(out, "%s = {column = \"%s\", unit = \"%s\", late_ms = %.4g}\n", COLUMN[i].signal,
              COLUMN[i].name, COLUMN[i].unit, late_ms[COLUMN[i].late]);
  motor_columns(h, out);
  // A range sample is taken at the beginning of its row's period, a row of means stands at the middle.
  if (job->truth.ceiling_m < 1e3)
    fprintf(out, "range = {column = \"up\", unit = \"m\", late_ms = %.4g}\n", h->means ? 0.5 * row_ms : 0.0);
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

// Writes the ceiling's effect as points, as a user measures them on a test stand.
static void write_ceiling(const nature_t *n, FILE *out) {
  double far[16], ratio[16];
  for (int i = 0; i < 16; i++) {
    far[i] = 0.1 + 0.9 * i;
    const double share = far[i] * n->radius_m / n->ceiling_m0;
    ratio[i] = 1.0 + n->ceiling_share / ((1.0 + share * share) * (1.0 + share * share));
  }
  fprintf(out, "\n[[effect]]\nname = \"ceiling\"\nform = \"table\"\n");
  list(out, "distance_over_radius", far, 16);
  list(out, "ratio", ratio, 16);
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
  if (n->ceiling_share > 0.0) write_ceiling(n, out);
  if (n->climb_kg > 0.0) fprintf(out, "\n[[effect]]\nname = \"climb_inflow\"\nk = %.7g\n", n->climb_kg);
}
