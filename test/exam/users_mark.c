// users_mark.c - marks a verdict against what was hidden.
//
// A hidden effect is right if it is named, or if a name of its family lists it among its rivals (or in
// `family`, where that is a list): the answer then says that these flights cannot tell the two apart. Beside
// a hidden battery_sag, whose zero is not the library's, mass and thrust_scale are not wrong, but the set is
// not exact.
#include "exam/users.h"

#include <stdio.h>
#include <string.h>

// Families of effects that some flights cannot separate: lift, time, push, moment, drag, place.
static const char *const FAMILY[][8] = {
    {"mass", "thrust_scale", "accel_bias", "battery_sag", "climb_inflow", "motor_damage", "thrust_curve"},
    {"motor_lag", "delay"},
    {"wind", "accel_bias", "imu_misalignment", "motor_tilt"},
    {"cg_offset", "motor_damage", "imu_misalignment", "motor_tilt"},
    {"rotor_drag", "body_drag", "wind"},
    {"ceiling", "tof_bias", "battery_sag"},
};
#define FAMILIES ((int)(sizeof FAMILY / sizeof *FAMILY))

static bool in(const char *const list[8], const char *name) {
  for (int i = 0; i < 8 && list[i]; i++)
    if (strcmp(list[i], name) == 0) return true;
  return false;
}

static bool of_one_family(const char *a, const char *b) {
  for (int i = 0; i < FAMILIES; i++)
    if (in(FAMILY[i], a) && in(FAMILY[i], b)) return true;
  return false;
}

static bool lists(const cJSON *effect, const char *key, const char *name) {
  const cJSON *one;
  cJSON_ArrayForEach(one,
                     cJSON_GetObjectItem(effect, key)) if (cJSON_IsString(one) &&
                                                           strcmp(one->valuestring, name) == 0) return true;
  return false;
}

static const char *text_of(const cJSON *object, const char *key) {
  const char *const text = cJSON_GetStringValue(cJSON_GetObjectItem(object, key));
  return text ? text : "";
}

// Returns which hidden effect this name stands for; -1: none.
static int which(const users_set_t *set, const cJSON *effect) {
  const char *const name = text_of(effect, "name");
  for (int k = 0; k < set->n; k++)
    if (strcmp(set->hidden[k], name) == 0) return k;
  for (int k = 0; k < set->n; k++) {
    const bool told = lists(effect, "rivals", set->hidden[k]) || lists(effect, "family", set->hidden[k]);
    if (told && of_one_family(name, set->hidden[k])) return k;
  }
  return -1;
}

static void mark_effect(users_set_t *set, const cJSON *effect, bool found[USERS_HIDDEN]) {
  const char *const name = text_of(effect, "name");
  const int k = which(set, effect);
  const bool right = k >= 0 && !found[k];
  bool sag = false;
  for (int i = 0; i < set->n; i++) sag = sag || strcmp(set->hidden[i], "battery_sag") == 0;
  const bool beside = !right && sag && (strcmp(name, "mass") == 0 || strcmp(name, "thrust_scale") == 0);
  if (right) found[k] = true;
  set->names++;
  set->right += right;
  set->beside += beside;
  set->wrong += !right && !beside;
  // NaN if it is not there.
  reliability_add(&set->stated, cJSON_GetNumberValue(cJSON_GetObjectItem(effect, "probability")),
                  right || beside);
  const size_t used = strlen(set->answer);
  snprintf(set->answer + used, sizeof set->answer - used, "%s%s", used ? "+" : "", name);
}

static void mark_unknown(users_set_t *set, const cJSON *unknown) {
  static const char *const channel[] = {"force_x", "force_y", "force_z", "turn_x", "turn_y", "turn_z"};
  const char *const at = set->strange.coordinate, *const said = text_of(unknown, "coordinate");
  set->unknown = true;
  set->told_differ = cJSON_GetArraySize(cJSON_GetObjectItem(unknown, "from_flight_to_flight")) > 0;
  const size_t used = strlen(set->answer);
  snprintf(set->answer + used, sizeof set->answer - used, " UNKNOWN %s at %s", text_of(unknown, "channel"),
           said);
  if (!set->strange.what) return;
  const bool level = strcmp(at, "xy") == 0 && (strcmp(said, "x") == 0 || strcmp(said, "y") == 0);
  const bool high = strcmp(at, "height") == 0 && strcmp(said, "ceiling distance") == 0;
  for (unsigned k = 0; k < 6; k++)
    if ((set->strange.channels >> k & 1u) && strcmp(channel[k], text_of(unknown, "channel")) == 0)
      set->located = at[0] == '\0' || level || high || strcmp(at, said) == 0;
}

void users_mark(users_set_t *set, const cJSON *verdict) {
  bool found[USERS_HIDDEN] = {false};
  const cJSON *effect;
  set->refused = strcmp(text_of(verdict, "verdict"), "refused") == 0;
  set->answer[0] = '\0';
  cJSON_ArrayForEach(effect, cJSON_GetObjectItem(verdict, "effects")) mark_effect(set, effect, found);
  const cJSON *const unknown = cJSON_GetObjectItem(verdict, "unknown");
  if (cJSON_IsObject(unknown)) mark_unknown(set, unknown);
  const char *const line =
      cJSON_GetStringValue(cJSON_GetArrayItem(cJSON_GetObjectItem(verdict, "warnings"), 0));
  if (set->refused) snprintf(set->answer, sizeof set->answer, "refused: %s", line ? line : "");
  if (!set->answer[0]) snprintf(set->answer, sizeof set->answer, "nothing");
}

bool users_exact(const users_set_t *set) {
  if (set->cause) return set->refused && strstr(set->answer, set->cause);
  if (set->strange.what) return set->located && set->names == 0;
  return !set->refused && set->right == set->n && set->wrong == 0 && set->beside == 0;
}
