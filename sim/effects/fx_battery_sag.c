// fx_battery_sag.c - thrust falls with the voltage beyond what the thrust map says. zero: the
// voltage at which the map holds.
#include "effects/fx.h"
#include "plant/battery.h"

static void tick(const fx_use_t *use, const fx_tick_t *tick, fx_plant_t *plant) {
  const double scale = 1.0 - use->p[0] * (1.0 - tick->vbat_V / use->p[2]);
  for (int i = 0; i < ROTORS; i++) fx_scale_rotor(plant, i, scale > 0.0 ? scale : 0.0, use->p[1]);
}

const fx_t fx_battery_sag = {
    .name = "battery_sag",
    .brief = "thrust falls with the voltage beyond what the thrust map says",
    .law = "each rotor gives T_i (1 - k (1 - vbat/zero)), not below 0",
    .fly = "a long flight, or full and empty batteries, with throttle steps",
    .over = {"voltage"},
    .in = "force_z",
    .apart = {{"thrust_scale", "one hover on a full battery until it is nearly empty"},
              {"mass", "one hover on a full battery until it is nearly empty"},
              {"thrust_curve", "the same throttle steps on a full and on a nearly empty battery"}},
    .needs = FX_NEEDS_VOLTAGE,
    .scales_thrust = true,
    .n_size = 1,
    .size = {{0, 0.05, 1, 0.0, FX_SAME}},
    .shape_param = 2,
    .n_shape = 3,
    .shape = {3.7, 3.95, 4.2},
    .shape_by_cell = true,
    .kind_param = 1,
    .n_kind = 2,
    .kind = {1.0, 0.0},
    .n_param = 3,
    .param = {{"k", "", 0.0, 0.6, 4.0}, FX_TORQUE, {"zero", "V", 2.5, BATTERY_FULL_V, 60.0}},
    .tick = tick,
};
