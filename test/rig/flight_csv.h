// flight_csv.h - logs of a flight whose every signal is known, whole or spoilt.
#ifndef TEST_RIG_FLIGHT_CSV_H
#define TEST_RIG_FLIGHT_CSV_H

#include "logs/columns.h"

#include <stdbool.h>
#include <stddef.h>

// Columns of the log, in a Crazyflie's names and units.
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

// What is wrong with a log. Zero: nothing.
typedef struct {
  double dt_ms;        // 0: 10 ms
  int rows;            // 0: 2000
  double late_att_s;   // attitude and
  double late_vel_s;   // velocity and position are late,
  double late_place_s; // the position by so much more
  double late_cmd_s;   // motor commands too
  int repeats_att;     // the attitude comes every so many rows, and stands in between; 0: in each
  int column;          // which columns: this one and
  int more;            // so many behind it
  double scale;        // 0: 1; times this ..
  double offset;       // .. plus this,
  double from_s;       // from here on,
  double to_s;         // before here; 0: to the end
  double hold_s;       // they stand still for so long from from_s on; 0: they do not
  int gap_rows;        // rows missing from from_s on
  int same_rows;       // rows behind from_s that all have its time
  const char *cell;    // what stands in `column` instead, in every
  int every;           // so many rows (0: all)
  bool drop;           // `column` is not there
  const char *rename;  // its name
} flight_csv_t;

// Writes the log into text; returns its size.
size_t flight_csv_write(const flight_csv_t *f, char *text, size_t room);

// The same into a scratch file; its path.
const char *flight_csv_file(const flight_csv_t *f, const char *name);

// The values of all columns at t_s, as a perfect log has them.
void flight_csv_values(double t_s, double v[FC_COLUMNS]);

// The columns to read such a log by: the Crazyflie's, of sensors without filters.
columns_t flight_csv_columns(void);

extern const char *const flight_csv_name[FC_COLUMNS];

#endif
