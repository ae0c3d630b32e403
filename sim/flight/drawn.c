// drawn.c - random deviations of one flight's vehicle, sensors and air.
#include "flight/drawn.h"

#include <math.h>
#include <string.h>

#define STREAM 0x5851f42d4c957f2du // xor with the seed: another stream than the sensors' and the air's

enum { GUST = 3, GUST_TAU }; // parameters of the effect `wind`

#define FIELD(key, member)                                                                                   \
  { .name = key, .offset = offsetof(drawn_t, member) }

const drawn_field_t drawn_fields[] = {
    FIELD("gust_mps2", gust_mps2),
    FIELD("mass", mass),
    FIELD("thrust", thrust),
    FIELD("rotor", rotor),
    {"rotor_number", offsetof(drawn_t, rotor_number), .which = true},
    FIELD("lag", lag),
    FIELD("delay_s", delay_s),
    FIELD("acc_bias_x_mps2", acc_bias_b_mps2.x),
    FIELD("acc_bias_y_mps2", acc_bias_b_mps2.y),
    FIELD("acc_bias_z_mps2", acc_bias_b_mps2.z),
    FIELD("up_scale", up_scale),
    FIELD("up_offset_m", up_offset_m),
    FIELD("down_scale", down_scale),
    FIELD("down_offset_m", down_offset_m),
    FIELD("curve_a", curve_a),
    FIELD("curve_b", curve_b),
    FIELD("top_m", top_m),
    FIELD("mount_x_rad", mount_x_rad),
    FIELD("mount_y_rad", mount_y_rad),
};
const int drawn_field_count = (int)(sizeof drawn_fields / sizeof *drawn_fields);

double drawn_get(const drawn_t *drawn, const drawn_field_t *field) {
  double value;
  memcpy(&value, (const char *)drawn + field->offset, sizeof value);
  return value;
}

static double between(random_t *r, double lo, double hi) {
  return lo + (hi - lo) * random_uniform(r, 0.0, 1.0);
}
static double within(random_t *r, double half) {
  return half * random_uniform(r, -1.0, 1.0);
}

// A new row goes to the end, so that existing seeds draw what they drew before.
static drawn_t draw(const vary_t *v, random_t *r) {
  drawn_t d = {.gust_tau_s = v->gust_tau_s};
  d.gust_mps2 = between(r, v->gust_min_mps2, v->gust_max_mps2);
  d.mass = within(r, v->mass);
  d.thrust = within(r, v->thrust);
  d.rotor = within(r, v->rotor);
  d.rotor_number = 1.0 + fmin(floor(random_uniform(r, 0.0, ROTORS)), ROTORS - 1.0);
  d.lag = within(r, v->lag);
  d.delay_s = between(r, 0.0, v->delay_s);
  d.acc_bias_b_mps2.x = v->acc_bias_mps2 * random_normal(r);
  d.acc_bias_b_mps2.y = v->acc_bias_mps2 * random_normal(r);
  d.acc_bias_b_mps2.z = v->acc_bias_mps2 * random_normal(r);
  d.up_scale = within(r, v->range_scale);
  d.up_offset_m = within(r, v->range_m);
  d.down_scale = within(r, v->range_scale);
  d.down_offset_m = within(r, v->range_m);
  d.curve_a = within(r, v->curve_a);
  d.curve_b = within(r, v->curve_b);
  d.top_m = between(r, v->top_min_m, v->top_max_m);
  d.mount_x_rad = within(r, v->mount_rad);
  d.mount_y_rad = within(r, v->mount_rad);
  return d;
}

done_t drawn_of(const vary_t *vary, uint64_t seed, drawn_t *drawn, why_t *why) {
  random_t *const random = random_open(seed ^ STREAM);
  if (!random) return error_failed(why, "out of memory");
  *drawn = draw(vary, random);
  random_close(random);
  return DONE;
}

void drawn_sense(const drawn_t *d, noise_t *noise) {
  imu_param_t *const imu = &noise->imu;
  range_param_t *const range = &noise->range;
  imu->acc_bias_b_mps2 = d3_add(imu->acc_bias_b_mps2, d->acc_bias_b_mps2);
  imu->mount_rad.x += d->mount_x_rad;
  imu->mount_rad.y += d->mount_y_rad;
  range->up_scale += d->up_scale;
  range->up_offset_m += d->up_offset_m;
  range->down_scale += d->down_scale;
  range->down_offset_m += d->down_offset_m;
}

static void vary_rotors(const drawn_t *d, model_t *model) {
  for (int i = 0; i < ROTORS; i++) {
    const double own = i == (int)d->rotor_number - 1 ? d->rotor : 0.0;
    model->rotor_more[i] = (1.0 + model->rotor_more[i]) * (1.0 + d->thrust) * (1.0 + own) - 1.0;
  }
}

static void vary_ceiling(const drawn_t *d, model_t *model) {
  for (int i = 0; i < model->n_fx; i++) {
    fx_use_t *const use = &model->fx[i];
    if (use->fx->surface == SURFACE_CEILING && use->form->vary)
      use->form->vary(use->p, &use->points, 1.0 + d->curve_a, 1.0 + d->curve_b);
  }
}

static done_t add_gusts(const drawn_t *d, model_t *model, why_t *why) {
  const fx_t *const wind = fx_find("wind");
  const fx_use_t *const own = model_fx(model, wind);
  if (!(d->gust_mps2 > 0.0) || (own && own->p[GUST] > 0.0)) return DONE;
  fx_use_t use = fx_use(wind);
  if (own)
    use = *own;
  else
    memset(use.p, 0, sizeof use.p);
  use.p[GUST] = model->mass_kg * d->gust_mps2;
  use.p[GUST_TAU] = d->gust_tau_s;
  return model_add_fx(model, &use, why);
}

done_t drawn_vehicle(const drawn_t *d, model_t *model, why_t *why) {
  model->mass_kg *= 1.0 + d->mass;
  model->motor_tau_s *= 1.0 + d->lag;
  model->frame.motor_delay_s += d->delay_s;
  model->frame.top_above_rotor_m += d->top_m;
  vary_rotors(d, model);
  vary_ceiling(d, model);
  return add_gusts(d, model, why);
}
