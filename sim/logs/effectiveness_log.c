// effectiveness_log.c - rates and commands from a log.
#include "logs/effectiveness_log.h"

const char *const effectiveness_names[COLUMNS] = {
    "tick",
    "controller.r_roll",
    "controller.r_pitch",
    "controller.r_yaw",
    "controller.cmd_roll",
    "controller.cmd_pitch",
    "controller.cmd_yaw",
    "controller.cmd_thrust",
};

static const char *const own_names[OWN_COLUMNS] = {"indiIn.step", "indiIn.p", "indiIn.q", "indiIn.r",
                                                   "indi.m1",     "indi.m2",  "indi.m3",  "indi.m4"};

static done_t find_own(effectiveness_log_t *p) {
  static const char *const event = "indiCall";
  if (p->table.usd) (void)usd_only(p->table.usd, &event, 1);
  for (int i = 0; i < OWN_COLUMNS; i++) {
    p->own_column[i] = table_find(&p->table, own_names[i]);
    if (p->own_column[i] < 0) return BAD_INPUT;
  }
  p->own = true;
  p->column[TIME] = p->own_column[OWN_TIME];
  p->column[THRUST] = p->own_column[OWN_FORCE];
  return DONE;
}

done_t effectiveness_log_find(effectiveness_log_t *p, why_t *why) {
  for (int i = 0; i < COLUMNS; i++) p->column[i] = table_find(&p->table, effectiveness_names[i]);
  if (p->column[TIME] < 0) p->column[TIME] = table_find(&p->table, "timestamp");
  for (int i = 0; i < THRUST; i++) {
    if (p->column[i] >= 0) continue;
    if (find_own(p) == DONE) return DONE;
    return table_refuse(&p->table, 0, -1, why, "column %s: missing%s", effectiveness_names[i],
                        i == TIME ? "; allowed: tick or timestamp, in ms" : "");
  }
  return DONE;
}

// Reads the commands that the firmware's mixer would have got: the inverse of its sums and differences, with
// roll and pitch halved.
static done_t read_own(const effectiveness_log_t *p, double row[COLUMNS], why_t *why) {
  double own[OWN_COLUMNS];
  for (int i = 0; i < OWN_COLUMNS; i++)
    TRY(table_number(&p->table, p->own_column[i], CSV_GAP_REFUSED, &own[i], why));
  const double k = 65535.0 / p->motor_max_N, *f = own + OWN_FORCE;
  row[TIME] = own[OWN_TIME];
  row[RATE] = own[OWN_RATE];
  row[RATE + 1] = -own[OWN_RATE + 1]; // nose up
  row[RATE + 2] = own[OWN_RATE + 2];
  row[COMMAND] = 0.5 * k * (-f[0] - f[1] + f[2] + f[3]);
  row[COMMAND + 1] = 0.5 * k * (f[0] - f[1] - f[2] + f[3]);
  row[COMMAND + 2] = 0.25 * k * (f[0] - f[1] + f[2] - f[3]);
  row[THRUST] = 0.25 * k * (f[0] + f[1] + f[2] + f[3]);
  return DONE;
}

done_t effectiveness_log_row(const effectiveness_log_t *p, double row[COLUMNS], why_t *why) {
  for (int i = 0; i < COLUMNS && !p->own; i++) {
    row[i] = 0.0;
    if (p->column[i] >= 0) TRY(table_number(&p->table, p->column[i], CSV_GAP_REFUSED, &row[i], why));
  }
  if (p->own) TRY(read_own(p, row, why));
  row[RATE + 2] = -row[RATE + 2]; // clockwise, as its command
  return DONE;
}
