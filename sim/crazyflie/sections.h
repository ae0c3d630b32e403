// sections.h - the app's parameters and logs, as its own source declares them, for the host.
//
// Addresses are those of the app's one static state; crazyflie.h turns them into a vehicle's own.
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

// All groups, in the order of the linker; how many there are.
int sections_param_groups(const section_param_group_t *const **first);
int sections_log_groups(const section_log_group_t *const **first);

// All logs one after the other: how many, and the name and entry of each. name: "group.name", at most 32.
int sections_logs(void);
const section_log_t *sections_log_at(int i, char name[32]);

// The same by group and name; group: a null pointer is allowed. A null pointer: there is none of that number.
int sections_params(void);
const section_param_t *sections_param_at(int i, const char **group);
const section_log_t *sections_log_in(int i, const char **group);

// Where the app triggers the firmware's events.
typedef struct {
  const char *name;
} section_event_t;

// A null pointer: the app triggers none of that name.
const section_event_t *sections_event(const char *name);

// "group.name"; a null pointer: there is none.
const section_param_t *sections_param(const char *full_name);
const section_log_t *sections_log(const char *full_name);

#endif
