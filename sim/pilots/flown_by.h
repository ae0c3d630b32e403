// flown_by.h - which controller flew the logs of a vehicle, as far as its file says (the table [controller],
// controller_file.h).
#ifndef SIM_PILOTS_FLOWN_BY_H
#define SIM_PILOTS_FLOWN_BY_H

#include "crazyflie/stock_pid.h"

typedef enum { FLOWN_BY_UNKNOWN, FLOWN_BY_OTHER, FLOWN_BY_STOCK_PID, FLOWN_BY_INDI } flown_by_kind_t;

#define FLOWN_BY_SETS 32

typedef struct {
  char name[28]; // group.name of flight/params.h
  double value;
} flown_by_set_t;

typedef struct {
  flown_by_kind_t kind;
  double rate_Hz;        // FLOWN_BY_OTHER: how often it commands the motors
  stock_pid_param_t pid; // FLOWN_BY_STOCK_PID; of `power` only thrust_max_N is read: one motor at 65535
  int n_set;             // FLOWN_BY_INDI: parameters that the file sets
  flown_by_set_t set[FLOWN_BY_SETS];
} flown_by_t;

#endif
