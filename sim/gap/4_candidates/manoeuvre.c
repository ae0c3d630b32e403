// manoeuvre.c - where an effect shows, and what to fly to tell it from another one: two tables.
#include "gap/4_candidates/manoeuvre.h"

#include <stdio.h>
#include <string.h>

static const struct {
  const char *name;
  where_t where;
} WHERE[] = {
    {"ceiling", {{"ceiling distance"}, "force_z"}},
    {"ceiling_rpm", {{"ceiling distance"}, "turn_z"}},
    {"ground", {{"height"}, "force_z"}},
    {"sidewall", {{"y"}, NULL}},
    {"rotor_drag", {{"v_x", "v_y"}, NULL}},
    {"body_drag", {{"v_x", "v_y"}, NULL}},
    {"flapping", {{"v_x", "v_y"}, NULL}},
    {"translational_lift", {{"v_x", "v_y"}, "force_z"}},
    {"climb_inflow", {{"v_z"}, "force_z"}},
    {"battery_sag", {{"voltage"}, "force_z"}},
    {"motor_lag", {{"thrust"}, NULL}},
    {"delay", {{"thrust"}, NULL}},
    {"motor_damage", {{"thrust"}, NULL}},
    {"mass", {{"time"}, NULL}},
    {"thrust_scale", {{"thrust"}, NULL}},
    {"cg_offset", {{"thrust"}, NULL}},
    {"inertia", {{"roll rate", "yaw rate"}, NULL}},
    {"accel_bias", {{"time"}, NULL}},
    {"imu_misalignment", {{"thrust"}, NULL}},
    {"wind", {{"time"}, NULL}},
    {"tof_bias", {{"height"}, NULL}},
    {"tof_floor", {{"ceiling distance", "height"}, NULL}},
    {"tof_latency", {{"v_z"}, NULL}},
    {"thrust_curve", {{"thrust"}, NULL}},
    {"gyroscopic", {{"roll rate"}, NULL}},
};

// What changes one and leaves the other.
static const struct {
  const char *a, *b, *fly;
} APART[] = {
    {"ceiling", "battery_sag", "hold 5 cm under the ceiling on a full and on a nearly empty battery"},
    {"ceiling", "ground", "the same heights over the floor, once under the ceiling and once away from it"},
    {"ceiling", "thrust_scale", "hover half a metre below the ceiling, then 5 cm below it: a scale stays"},
    {"ceiling", "mass", "hover half a metre below the ceiling, then 5 cm below it: a mass stays"},
    {"ceiling", "climb_inflow", "hold still at 3, 5 and 9 cm under the ceiling: inflow needs a climb"},
    {"ceiling", "thrust_curve", "throttle steps far from the ceiling: a bent curve shows there too"},
    {"ceiling", "tof_bias", "stand still at measured distances: the bias is in the range alone"},
    {"ceiling", "ceiling_rpm", "log the rotor speeds while you hold 5 cm under the ceiling"},
    {"ground", "battery_sag", "hold 5 cm over the ground on a full and on a nearly empty battery"},
    {"ground", "thrust_scale", "hover half a metre up, then 5 cm over the ground: a scale stays"},
    {"ground", "mass", "hover half a metre up, then 5 cm over the ground: a mass stays"},
    {"ground", "climb_inflow", "hold still at 3, 5 and 9 cm over the ground: inflow needs a climb"},
    {"ground", "thrust_curve", "throttle steps half a metre up: a bent curve shows there too"},
    {"rotor_drag", "body_drag", "straight lines at 0.5 and 1.5 m/s: one grows threefold, the other ninefold"},
    {"rotor_drag", "wind", "the same line there and back: drag turns round, wind does not"},
    {"body_drag", "wind", "the same line there and back: drag turns round, wind does not"},
    {"rotor_drag", "accel_bias",
     "a line there and back without a yaw turn: drag turns round, a bias does not"},
    {"body_drag", "accel_bias",
     "a line there and back without a yaw turn: drag turns round, a bias does not"},
    {"rotor_drag", "imu_misalignment", "level flight at a steady speed, then throttle steps on the spot"},
    {"flapping", "cg_offset", "sideways steps both ways: flapping turns round, an offset stays"},
    {"flapping", "motor_damage", "sideways steps both ways: flapping turns round, a weak rotor stays weak"},
    {"motor_damage", "inertia", "a calm hover: damage shows there, inertia in attitude doublets alone"},
    {"cg_offset", "inertia", "a calm hover: an offset shows there, inertia in attitude doublets alone"},
    {"climb_inflow", "motor_lag", "a long steady climb: lag ends with the throttle step, inflow stays"},
    {"climb_inflow", "delay", "a long steady climb: delay ends with the throttle step, inflow stays"},
    {"climb_inflow", "body_drag", "climbs at 0.5 and 1 m/s: one doubles, the other grows fourfold"},
    {"translational_lift", "thrust_curve",
     "circles at two speeds and one height, then throttle steps on the spot"},
    {"translational_lift", "body_drag",
     "level circles at two speeds: lift is vertical, drag lies in the plane"},
    {"battery_sag", "thrust_scale", "one hover on a full battery until it is nearly empty"},
    {"battery_sag", "mass", "one hover on a full battery until it is nearly empty"},
    {"battery_sag", "thrust_curve", "the same throttle steps on a full and on a nearly empty battery"},
    {"motor_lag", "delay", "sharp throttle and attitude doublets, logged at 500 Hz"},
    {"motor_lag", "inertia", "slow and fast attitude doublets: lag hurts the fast ones alone"},
    {"delay", "inertia", "slow and fast attitude doublets: delay hurts the fast ones alone"},
    {"motor_damage", "cg_offset", "throttle steps: a weak rotor yaws the vehicle too, an offset does not"},
    {"mass", "thrust_scale",
     "attitude doublets, logged at 500 Hz: a thrust scale changes moments too, a mass does not"},
    {"mass", "accel_bias", "throttle steps of 20 %: a bias stays, what a mass does grows with the thrust"},
    {"thrust_scale", "accel_bias", "throttle steps of 20 %: a bias stays, a scale grows with the thrust"},
    {"thrust_scale", "thrust_curve", "long climbs and descents with a wide range of throttle"},
    {"thrust_scale", "inertia", "throttle steps without turning, then attitude doublets"},
    {"accel_bias", "imu_misalignment",
     "throttle steps of 20 %: a bias stays, the other grows with the thrust"},
    {"sidewall", "wind", "the same height beside the wall and away from it: wind is there too"},
    {"sidewall", "accel_bias", "beside the wall and away from it: a bias stays"},
    {"accel_bias", "wind", "a full yaw turn on the spot: a bias turns with the body, wind does not"},
    {"imu_misalignment", "wind",
     "a full yaw turn on the spot: the sensor turns with the body, wind does not"},
    {"tof_bias", "tof_latency", "the same vertical sweep up and down: latency changes its sign"},
    {"tof_bias", "tof_floor", "a vertical sweep from far to contact: a bias is there far away too"},
    {"tof_floor", "tof_latency", "stand still near the surface: latency needs a climb"},
};

where_t manoeuvre_where(const fx_t *fx) {
  for (unsigned i = 0; i < sizeof WHERE / sizeof *WHERE; i++)
    if (strcmp(WHERE[i].name, fx->name) == 0) return WHERE[i].where;
  return (where_t){{NULL, NULL}, NULL};
}

const char *manoeuvre_show(const fx_t *fx) {
  return fx->fly ? fx->fly : "any flight";
}

static bool is(const char *a, const char *b, const fx_t *x, const fx_t *y) {
  return strcmp(a, x->name) == 0 && strcmp(b, y->name) == 0;
}

void manoeuvre_apart(const fx_t *fx, const fx_t *rival, char text[MANOEUVRE_BYTES]) {
  for (unsigned i = 0; i < sizeof APART / sizeof *APART; i++) {
    if (!is(APART[i].a, APART[i].b, fx, rival) && !is(APART[i].a, APART[i].b, rival, fx)) continue;
    snprintf(text, MANOEUVRE_BYTES, "%s", APART[i].fly);
    return;
  }
  const char *const own = manoeuvre_show(fx), *const other = manoeuvre_show(rival);
  const bool same = strcmp(own, other) == 0;
  snprintf(text, MANOEUVRE_BYTES, "%s%s%s", own, same ? "" : "; then ", same ? "" : other);
}
