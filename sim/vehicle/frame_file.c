// frame_file.c - reads body, rotors, battery and range sensors from a vehicle file.
#include "vehicle/frame_file.h"

#include "base/text.h"
#include <math.h>
#include <string.h>

typedef struct {
  const char *key;
  double min, max, *value;
} number_t;

// Reads the numbers that are present; the others keep their values.
static done_t read_numbers(toml_t t, const number_t *row, int n, why_t *why) {
  for (int i = 0; i < n; i++)
    if (toml_has(t, row[i].key)) TRY(toml_double(t, row[i].key, row[i].min, row[i].max, row[i].value, why));
  return DONE;
}

// Reads a list of exactly n numbers within min..max, if it is present.
static done_t read_list(toml_t t, const char *key, int n, double min, double max, double *value, why_t *why) {
  double list[ROTORS];
  int got;
  if (!toml_has(t, key)) return DONE;
  TRY(toml_doubles(t, key, n, list, &got, why));
  if (got != n) return toml_refuse(t, key, why, "%d numbers; allowed: %d", got, n);
  for (int i = 0; i < n; i++)
    if (!(list[i] >= min && list[i] <= max))
      return toml_refuse(t, key, why, "%g is out of range; allowed: %g to %g", list[i], min, max);
  for (int i = 0; i < n; i++) value[i] = list[i];
  return DONE;
}

static done_t read_body(toml_t t, frame_t *f, why_t *why) {
  static const char *const keys[] = {"inertia_kgm2",
                                     "cg_above_feet_m",
                                     "rotor_above_feet_m",
                                     "top_above_rotor_m",
                                     "top_half_m",
                                     "imu_m",
                                     NULL};
  const number_t row[] = {
      {"cg_above_feet_m", 1e-4, 2.0, &f->cg_above_feet_m},
      {"rotor_above_feet_m", 0.0, 2.0, &f->rotor_above_feet_m},
      {"top_above_rotor_m", -2.0, 2.0, &f->top_above_rotor_m},
      {"top_half_m", 0.0, 2.0, &f->top_half_m},
  };
  TRY(toml_only(t, keys, why));
  TRY(read_numbers(t, row, (int)(sizeof row / sizeof *row), why));
  TRY(read_list(t, "inertia_kgm2", 3, 1e-9, 1e3, f->inertia_kgm2, why));
  return read_list(t, "imu_m", 3, -1.0, 1.0, f->imu_m, why);
}

// Largest imbalance over the sum of the rotors' distances from the centre: neighbours that turn alike give
// 0.7, opposite rotors that do give 0.
#define ASKEW 0.35

static done_t read_rotors(toml_t t, frame_t *f, why_t *why) {
  static const char *const keys[] = {"x_m",    "y_m",          "spin",    "torque_ratio_m",
                                     "kf_Ns2", "inertia_kgm2", "delay_s", NULL};
  const number_t row[] = {
      {"torque_ratio_m", 0.0, 1.0, &f->torque_ratio_m},
      {"kf_Ns2", 1e-12, 1.0, &f->kf_Ns2},
      {"inertia_kgm2", 0.0, 1.0, &f->rotor_inertia_kgm2},
      {"delay_s", 0.0, 0.2, &f->motor_delay_s},
  };
  TRY(toml_only(t, keys, why));
  TRY(read_numbers(t, row, (int)(sizeof row / sizeof *row), why));
  TRY(read_list(t, "x_m", ROTORS, -5.0, 5.0, f->rotor_x_m, why));
  TRY(read_list(t, "y_m", ROTORS, -5.0, 5.0, f->rotor_y_m, why));
  TRY(read_list(t, "spin", ROTORS, -1.0, 1.0, f->rotor_spin, why));
  double sum = 0.0, roll_m = 0.0, pitch_m = 0.0, size_m = 0.0; // of the moments that a moment about z causes
  for (int i = 0; i < ROTORS; i++) {
    sum += f->rotor_spin[i];
    roll_m += f->rotor_spin[i] * f->rotor_y_m[i];
    pitch_m += f->rotor_spin[i] * f->rotor_x_m[i];
    size_m += hypot(f->rotor_x_m[i], f->rotor_y_m[i]);
    if (f->rotor_spin[i] > -1.0 && f->rotor_spin[i] < 1.0)
      return toml_refuse(t, "spin", why, "%g; allowed: 1 and -1", f->rotor_spin[i]);
  }
  if (sum < 0.0 || sum > 0.0)
    return toml_refuse(t, "spin", why, "%g rotors of 1; allowed: 2, else the torques of a hover turn it",
                       0.5 * (ROTORS + sum));
  if (hypot(roll_m, pitch_m) > ASKEW * size_m)
    return toml_refuse(t, "spin", why, "rotors of 1 lie on one side; allowed: opposite ones turn alike");
  return DONE;
}

static done_t read_battery(toml_t t, battery_param_t *b, why_t *why) {
  static const char *const keys[] = {"capacity_Ah", "resistance_ohm", "idle_A", "a_ApN",
                                     "b_ApN2",      "open_V",         NULL};
  double capacity_Ah;
  TRY(toml_only(t, keys, why));
  TRY(toml_double(t, "capacity_Ah", 1e-3, 1e3, &capacity_Ah, why));
  TRY(toml_double(t, "resistance_ohm", 0.0, 10.0, &b->resistance_ohm, why));
  TRY(toml_double(t, "idle_A", 0.0, 100.0, &b->idle_A, why));
  TRY(toml_double(t, "a_ApN", 0.0, 1e3, &b->a_ApN, why));
  TRY(toml_double(t, "b_ApN2", 0.0, 1e4, &b->b_ApN2, why));
  TRY(toml_doubles(t, "open_V", BATTERY_TABLE_MAX, b->open_V, &b->n, why));
  if (b->n < 2) return toml_refuse(t, "open_V", why, "%d numbers; allowed: 2 to %d", b->n, BATTERY_TABLE_MAX);
  for (int i = 0; i < b->n; i++)
    if (!(b->open_V[i] >= (i ? b->open_V[i - 1] : 0.0) && b->open_V[i] <= 100.0))
      return toml_refuse(t, "open_V", why, "%g; allowed: 0 to 100, not falling", b->open_V[i]);
  b->capacity_As = 3600.0 * capacity_Ah;
  return DONE;
}

static done_t read_range(toml_t root, const char *name, range_told_t *range, why_t *why) {
  static const char *const keys[] = {"period_s", "age_s", "noise_m", "floor_m", NULL};
  toml_t t;
  *range = (range_told_t){0};
  if (!toml_has(root, name)) return DONE;
  TRY(toml_table(root, name, &t, why));
  TRY(toml_only(t, keys, why));
  range->told = true;
  const number_t row[] = {{"period_s", 0.0, 1.0, &range->period_s},
                          {"age_s", 0.0, 1.0, &range->age_s},
                          {"noise_m", 0.0, 1.0, &range->noise_m},
                          {"floor_m", 0.0, 1.0, &range->floor_m}};
  return read_numbers(t, row, (int)(sizeof row / sizeof *row), why);
}

// The keys for which model_frame_like_crazyflie has a default; bit i of frame_lacks is number i.
static const struct {
  const char *table, *key;
} SCALED[] = {
    {"body", "inertia_kgm2"},
    {"body", "cg_above_feet_m"},
    {"body", "rotor_above_feet_m"},
    {"body", "top_above_rotor_m"},
    {"body", "top_half_m"},
    {"rotors", "x_m"},
    {"rotors", "y_m"},
    {"rotors", "spin"},
    {"rotors", "torque_ratio_m"},
    {"rotors", "kf_Ns2"},
    {"rotors", "inertia_kgm2"},
};
#define SCALEDS ((int)(sizeof SCALED / sizeof *SCALED))

static unsigned lacks(toml_t root) {
  unsigned bits = 0;
  for (int i = 0; i < SCALEDS; i++) {
    toml_t t;
    why_t ignored;
    const bool there = toml_has(root, SCALED[i].table) &&
                       toml_table(root, SCALED[i].table, &t, &ignored) == DONE && toml_has(t, SCALED[i].key);
    if (!there) bits |= 1u << i;
  }
  return bits;
}

// The bits of all keys of the table.
static unsigned whole(const char *table) {
  unsigned bits = 0;
  for (int i = 0; i < SCALEDS; i++)
    if (strcmp(SCALED[i].table, table) == 0) bits |= 1u << i;
  return bits;
}

const char *frame_lacks(const model_t *m, char text[FRAME_LACKS]) {
  unsigned said = 0;
  text[0] = '\0';
  for (int i = 0; i < SCALEDS; i++) {
    const unsigned all = whole(SCALED[i].table), bit = 1u << i;
    if (!(m->frame_lacks & bit) || (said & bit)) continue;
    const bool none = (m->frame_lacks & all) == all;
    said |= none ? all : bit;
    text_add(text, FRAME_LACKS, none ? "%s[%s]%s" : "%s%s.%s", text[0] ? ", " : "", SCALED[i].table,
             none ? "" : SCALED[i].key);
  }
  return text;
}

bool frame_lacks_key(const model_t *m, const char *table, const char *key) {
  for (int i = 0; i < SCALEDS; i++)
    if (strcmp(SCALED[i].table, table) == 0 && strcmp(SCALED[i].key, key) == 0)
      return m->frame_lacks & 1u << i;
  return false;
}

done_t frame_read(toml_t root, model_t *m, why_t *why) {
  toml_t t;
  frame_t frame = model_frame_like_crazyflie(m);
  battery_param_t battery = {0};
  if (toml_has(root, "body")) {
    TRY(toml_table(root, "body", &t, why));
    TRY(read_body(t, &frame, why));
  }
  if (toml_has(root, "rotors")) {
    TRY(toml_table(root, "rotors", &t, why));
    TRY(read_rotors(t, &frame, why));
  }
  if (toml_has(root, "battery")) {
    TRY(toml_table(root, "battery", &t, why));
    TRY(read_battery(t, &battery, why));
  }
  TRY(read_range(root, "range_up", &m->range_up, why));
  TRY(read_range(root, "range_down", &m->range_down, why));
  m->frame = frame;
  m->frame_told = toml_has(root, "body") && toml_has(root, "rotors");
  m->frame_lacks = lacks(root);
  m->battery = battery;
  return DONE;
}
