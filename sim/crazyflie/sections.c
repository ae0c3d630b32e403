// sections.c - the app's parameters and logs, from the linker.
#include "sections.h"

#include <string.h>

extern const section_param_group_t *const __start_crazyflie_params[], *const __stop_crazyflie_params[];
extern const section_log_group_t *const __start_crazyflie_logs[], *const __stop_crazyflie_logs[];

extern const section_event_t *const __start_crazyflie_events[], *const __stop_crazyflie_events[];

static int between(const void *start, const void *stop) {
  return (int)(((uintptr_t)stop - (uintptr_t)start) / sizeof(void *));
}

int sections_param_groups(const section_param_group_t *const **first) {
  *first = __start_crazyflie_params;
  return between(__start_crazyflie_params, __stop_crazyflie_params);
}

int sections_log_groups(const section_log_group_t *const **first) {
  *first = __start_crazyflie_logs;
  return between(__start_crazyflie_logs, __stop_crazyflie_logs);
}

// Returns what follows the group's name and the dot; null: it is of another group.
static const char *within(const char *full_name, const char *group) {
  const size_t size = strlen(group);
  return strncmp(full_name, group, size) == 0 && full_name[size] == '.' ? full_name + size + 1 : NULL;
}

const section_param_t *sections_param(const char *full_name) {
  const section_param_group_t *const *group;
  const int n = sections_param_groups(&group);
  for (int i = 0; i < n; i++) {
    const char *const name = within(full_name, group[i]->name);
    for (const section_param_t *p = group[i]->param; name && p->name; p++)
      if (strcmp(p->name, name) == 0) return p;
  }
  return NULL;
}

const section_log_t *sections_log(const char *full_name) {
  const section_log_group_t *const *group;
  const int n = sections_log_groups(&group);
  for (int i = 0; i < n; i++) {
    const char *const name = within(full_name, group[i]->name);
    for (const section_log_t *l = group[i]->log; name && l->name; l++)
      if (strcmp(l->name, name) == 0) return l;
  }
  return NULL;
}

int sections_logs(void) {
  const section_log_group_t *const *group;
  const int groups = sections_log_groups(&group);
  int n = 0;
  for (int g = 0; g < groups; g++)
    for (const section_log_t *l = group[g]->log; l->name; l++) n++;
  return n;
}

const section_log_t *sections_log_in(int i, const char **name) {
  const section_log_group_t *const *group;
  const int n = sections_log_groups(&group);
  for (int g = 0; g < n; g++)
    for (const section_log_t *l = group[g]->log; l->name; l++) {
      if (i-- > 0) continue;
      if (name) *name = group[g]->name;
      return l;
    }
  return NULL;
}

const section_log_t *sections_log_at(int i, char name[32]) {
  const char *group;
  const section_log_t *const l = sections_log_in(i, &group);
  if (!l) return NULL;
  strncpy(name, group, 15); // both together at most 25 (firmware)
  name[15] = '\0';
  strcat(strcat(name, "."), l->name);
  return l;
}

int sections_params(void) {
  const section_param_group_t *const *group;
  const int groups = sections_param_groups(&group);
  int n = 0;
  for (int g = 0; g < groups; g++)
    for (const section_param_t *p = group[g]->param; p->name; p++) n++;
  return n;
}

const section_param_t *sections_param_at(int i, const char **name) {
  const section_param_group_t *const *group;
  const int n = sections_param_groups(&group);
  for (int g = 0; g < n; g++)
    for (const section_param_t *p = group[g]->param; p->name; p++) {
      if (i-- > 0) continue;
      if (name) *name = group[g]->name;
      return p;
    }
  return NULL;
}

const section_event_t *sections_event(const char *name) {
  const int n = between(__start_crazyflie_events, __stop_crazyflie_events);
  for (int i = 0; i < n; i++)
    if (strcmp(__start_crazyflie_events[i]->name, name) == 0) return __start_crazyflie_events[i];
  return NULL;
}
