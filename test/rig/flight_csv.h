// flight_csv.h - logs of a flight whose every signal is known, intact or with a fault.
#ifndef TEST_RIG_FLIGHT_CSV_H
#define TEST_RIG_FLIGHT_CSV_H

#include "logs/columns.h"

#include <stdbool.h>
#include <stddef.h>

// Columns of the log, in the Crazyflie's names and units.
enum {
  FC_TIME,
  FC_X,
  FC_Y,
  FC_Z,
  FC_VX,
  FC_VY,
  FC_VZ,
  FC_AX,
  FC_AY,
  FC_AZ,
  FC_QW,
  FC_QX,
  FC_QY,
  FC_QZ,
  FC_GX,
  FC_GY,
  FC_GZ,
  FC_M1,
  FC_M2,
  FC_M3,
  FC_M4,
  FC_VBAT,
  FC_RANGE,
  FC_W1,
  FC_W2,
  FC_W3,
  FC_W4,
  FC_COLUMNS
};

// What is wrong with a log. All zero: nothing.
typedef struct {
  double dt_ms;        // 0: 10 ms
  int rows;            // 0: 2000
  double late_att_s;   // delay of the attitude
  double late_vel_s;   // delay of velocity and position
  double late_place_s; // further delay of the position
  double late_cmd_s;   // delay of the motor commands
  int repeats_att;     // rows per new attitude, which repeats in between; 0: new in each
  int column;          // first of the columns that the following changes
  int more;            // number of further columns
  double scale;        // factor; 0: 1
  double offset;       // added after `scale`
  double from_s;       // start of the fault
  double to_s;         // its end; 0: to the end
  double hold_s;       // from from_s on the columns hold their value for so long
  int gap_rows;        // rows missing from from_s on
  int same_rows;       // rows after from_s with the same time as it
  const char *cell;    // text in `column` in place of the number
  int every;           // ... in one of so many rows; 0: in all
  bool drop;           // leaves `column` out
  const char *rename;  // another name for `column`
} flight_csv_t;

// Writes the log into `text` of `room` bytes; returns its size.
size_t flight_csv_write(const flight_csv_t *f, char *text, size_t room);

// Writes the log to a scratch file; returns its path.
const char *flight_csv_file(const flight_csv_t *f, const char *name);

// The values of all columns at t_s in a perfect log.
void flight_csv_values(double t_s, double v[FC_COLUMNS]);

// The columns to read such a log by: the Crazyflie's, but without the delays of its filters.
columns_t flight_csv_columns(void);

extern const char *const flight_csv_name[FC_COLUMNS];

#endif
