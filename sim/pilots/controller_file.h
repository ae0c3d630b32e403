// controller_file.h - the table [controller] of a vehicle file: which controller flew its logs.
//
//   kind = "stock-pid"      the Crazyflie's PID cascade (crazyflie/stock_pid.h); its gains under the
//                           firmware's own parameter names, as shipped where they are left out:
//                           posCtlPid.xKp, xKi, xKd, yKp .. zKd, xVelMax, yVelMax, zVelMax, thrustBase,
//                           thrustMin; velCtlPid.vxKp .. vzKd; pid_attitude.roll_kp .. yaw_kd;
//                           pid_rate.roll_kp .. yaw_kd
//   full_scale_N = 0.12     of one motor at 65535; left out: a quarter of the vehicle's thrust_max_N
//
//   kind = "indi"           this project's flight code; parameters under their names (indiPos.cutoff = 8).
//                           Those left out have their defaults, but indiPos.mass and indiPos.tauMot then come
//                           from the vehicle file
//
//   kind = "other"          any other; nothing is known but how often it commands the motors
//   rate_Hz = 100           each command holds until the next
#ifndef SIM_PILOTS_CONTROLLER_FILE_H
#define SIM_PILOTS_CONTROLLER_FILE_H

#include "base/error.h"
#include "pilots/flown_by.h"
#include "vehicle/model.h"

// Reads the table from the vehicle file at `path`, or from `text` if that is not null, with `path` as its
// name. The rest of the file is read and checked by model_file.h. *by is FLOWN_BY_UNKNOWN without the table.
// m: the model of the file, for its thrust_max_N. BAD_INPUT: a key of the table is missing, unknown, of
// another type, or out of range.
MUST_CHECK done_t controller_read(const char *path, const char *text, const model_t *m, flown_by_t *by,
                                  why_t *why);

#endif
