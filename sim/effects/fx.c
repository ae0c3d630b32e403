// fx.c - effects by name, and an effect that is switched on.
#include "effects/fx.h"

#include <stddef.h>
#include <string.h>

const char fx_law_symbols[] =
    "T_i, Om_i, s_i: thrust (in free air), speed and sense of turning (1 counter-clockwise from above, "
    "else -1) of rotor i, T: thrust of all; F, M: force and moment that are added; v: velocity through "
    "the air, w: rates; axes of the body (x forwards, y to the left, z up) where no others are named, "
    "e_z: its z; a x b: the product of two vectors; f: specific force; d: rotor plane to surface, or "
    "what the range sensor should read, R: rotor radius; m, J, tau: mass, inertia and time constant of "
    "the motors; g: 9.81 m/s2; vbat: voltage of the battery; torque 1: a rotor's torque follows its "
    "thrust, 0: it stays; arm: how far from the centre of mass towards each hub (1) v is taken and F "
    "acts; each 1: every rotor has its own d, 0: all have that of their middle";

const fx_t *fx_find(const char *name) {
  for (int i = 0; i < fx_count; i++)
    if (strcmp(fx_table[i]->name, name) == 0) return fx_table[i];
  return NULL;
}

static const char *apart_from(const fx_t *fx, const fx_t *rival) {
  for (int i = 0; i < FX_APART_MAX && fx->apart[i].rival; i++)
    if (strcmp(fx->apart[i].rival, rival->name) == 0) return fx->apart[i].fly;
  return NULL;
}

const char *fx_apart(const fx_t *a, const fx_t *b) {
  const char *const fly = apart_from(a, b);
  return fly ? fly : apart_from(b, a);
}

const curve_t *curve_find(const char *name) {
  for (int i = 0; i < curve_count; i++)
    if (strcmp(curve_table[i]->name, name) == 0) return curve_table[i];
  return NULL;
}

const fx_param_t *fx_use_params(const fx_use_t *use, int *n) {
  *n = use->form ? use->form->n_param : use->fx->n_param;
  return use->form ? use->form->param : use->fx->param;
}

void fx_use_form(fx_use_t *use, const curve_t *form) {
  use->form = form;
  int n;
  const fx_param_t *param = fx_use_params(use, &n);
  for (int i = 0; i < n; i++) use->p[i] = param[i].nominal;
}

fx_use_t fx_use(const fx_t *fx) {
  fx_use_t use = {.fx = fx};
  fx_use_form(&use, fx->surface ? curve_find(fx->form_initial) : NULL);
  return use;
}
