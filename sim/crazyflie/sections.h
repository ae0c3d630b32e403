// sections.h - the app's parameters and logs, as its own source declares them, for the host.
//
// Addresses are in the app's one static state; crazyflie_at() turns them into those of a vehicle.
#ifndef CRAZYFLIE_SECTIONS_H
#define CRAZYFLIE_SECTIONS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct section_param {
  int type; // param.h
  const char *name;
  void *address;
  void (*callback)(void);
} section_param_t;

typedef struct {
  int type; // log.h
  const char *name;
  const void *address;
} section_log_t;

// The lists end with a null name.
typedef struct {
  const char *name;
  const section_param_t *param;
} section_param_group_t;

typedef struct {
  const char *name;
  const section_log_t *log;
} section_log_group_t;

// Return the number of groups; *first is the first, in the order of the linker.
int sections_param_groups(const section_param_group_t *const **first);
int sections_log_groups(const section_log_group_t *const **first);

// All logs one after the other: their number, and entry i with its name, "group.name". Null: there is none of
// that number.
int sections_logs(void);
const section_log_t *sections_log_at(int i, char name[32]);

// The same of parameters, and log i with its group's name in *group; group may be null. Null: there is none
// of that number.
int sections_params(void);
const section_param_t *sections_param_at(int i, const char **group);
const section_log_t *sections_log_in(int i, const char **group);

// An event of the firmware that the app triggers.
typedef struct {
  const char *name;
} section_event_t;

// Null: the app triggers none of that name.
const section_event_t *sections_event(const char *name);

// full_name: "group.name". Null: there is none.
const section_param_t *sections_param(const char *full_name);
const section_log_t *sections_log(const char *full_name);

#endif
