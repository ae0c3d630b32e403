// fx_wind.c - wind: a force in world axes, constant and with gusts, and air that moves (felt through the
// drags). `plane` 1: of fx and fy only the part in the rotors' plane acts, as of a steady wind that is felt
// through the rotors' drag: it does not lift a vehicle that leans into it. fz, of an updraft or a cable, acts
// as a whole. fx, fy, fz are in world axes all the same.
//
// The gusts are a first-order Gauss-Markov process of the given standard deviation on each axis, stepped at
// ticks, exact for any tick.
#include "effects/fx.h"
#include <math.h>

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  const double *p = use->p;
  plant->force_w_N = d3_add_scaled(plant->force_w_N, 1.0 - p[8], d3(p[0], p[1], 0.0));
  plant->force_w_N.z += p[2];
  plant->air_w_mps = d3_add(plant->air_w_mps, d3_of(p + 5));
  if (!(p[3] > 0.0)) return;
  // memory[3] says whether the process has begun. It begins with its stationary spread, not at 0.
  const double keep = tick->memory[3] > 0.0 ? exp(-tick->span_s / p[4]) : 0.0;
  const double fresh = p[3] * sqrt(1.0 - keep * keep);
  for (int i = 0; i < 3; i++) tick->memory[i] = keep * tick->memory[i] + fresh * random_normal(tick->random);
  tick->memory[3] = 1.0;
  plant->force_w_N = d3_add(plant->force_w_N, d3_of(tick->memory));
}

static void load(const fx_use_t *use, const fx_motion_t *motion, load_t *load) {
  const d3_t force_b_N = axes_to_body(motion->axes, d3(use->p[8] * use->p[0], use->p[8] * use->p[1], 0.0));
  load->force_b_N = d3_add(load->force_b_N, d3(force_b_N.x, force_b_N.y, 0.0));
}

const fx_t fx_wind = {
    .name = "wind",
    .brief = "a constant force (plane 1: of fx and fy the part in the rotors' plane alone), gusts, and "
             "moving air that the drags feel",
    .law = "F = (fx, fy, fz), world axes, plane 1: of (fx, fy) the part in the rotors' plane; and gusts of "
           "deviation `gust` and time constant `tau`; the air moves by (vx, vy, vz)",
    .fly = "a full yaw turn on the spot",
    .over = {"time"},
    .needs = FX_NEEDS_ATTITUDE,
    .n_size = 3,
    .size = {{0, 1e-4, 0, 0.0, FX_BY_MASS}, {1, 1e-4, 0, 0.0, FX_BY_MASS}, {2, 1e-4, 0, 0.0, FX_BY_MASS}},
    .size_apart = 2, // upwards it looks like less mass, or an accelerometer's bias
    .apart_name = "wind z",
    .kind_param = 8,
    .n_kind = 2,
    .kind = {0.0, 1.0},
    .n_param = 9,
    .param = {{"fx", "N", -50.0, 3e-3, 50.0},
              {"fy", "N", -50.0, 0.0, 50.0},
              {"fz", "N", -50.0, 0.0, 50.0},
              {"gust", "N", 0.0, 0.0, 50.0},
              {"tau", "s", 0.01, 0.3, 100.0},
              {"vx", "m/s", -20.0, 0.0, 20.0},
              {"vy", "m/s", -20.0, 0.0, 20.0},
              {"vz", "m/s", -20.0, 0.0, 20.0},
              {"plane", "number", 0.0, 0.0, 1.0}},
    .load = load,
    .tick = tick,
};
