// test_abreast.c - vehicles that are moved side by side: the bits of each are those that it has alone.
#include "base/lane.h"
#include "body/abreast.h"
#include "body/body.h"
#include "body/lanes_of.h"
#include "rig/vehicle6.h"
#include <stdlib.h>
#include <string.h>

#define FLIGHTS 20  // more than are moved at once
#define TICKS   400 // of the first; each has 10 fewer than the one before

// More than half of all ticks with both integrators.
#define MOST (FLIGHTS * (TICKS - 5 * (FLIGHTS - 1)))

typedef struct {
  const model_t *model, *other; // other: every third flight's
  integrate_kind_t kind;
  int bits;            // of the registers
  double climb_N;      // above hover: who climbs touches the ceiling
  bool pushed;         // each by a force of its own
  bool shaken;         // and by a moment, for 50 ticks and then not; every third always
  double other_step_s; // of the integrator, of every third; 0: as all
  bool held, vertical; // every third
  double y[FLIGHTS][RIGID_N], charge[FLIGHTS];
  int contacts;
} flights_t;

// Each from its own place, tilted.
static bool begin(const flights_t *f, int i, body_t *b) {
  const bool other = i % 3 == 1;
  const body_start_t start = {.pos_w_m = {0.1 * i, 0.0, 0.3 + 0.01 * i},
                              .vel_w_mps = {0.4 - 0.1 * i, 0.05 * i, 0.0},
                              .rate_b_radps = {0.1 * i, -0.2, 0.05 * i},
                              .thrust_N = {0.08, 0.08, 0.08, 0.08},
                              .seed = 7 + (uint64_t)i,
                              .held = f->held && other,
                              .vertical_only = f->vertical && other};
  const double step_s = other && f->other_step_s > 0.0 ? f->other_step_s : 0.002;
  return CHECK_OK(body_open(b, other ? f->other : f->model, f->kind, step_s, &start));
}

// With its own commands and gusts, and for its own time.
static bool order(const flights_t *f, int i, int k, body_t *b) {
  if (k >= TICKS - 10 * i) return false;
  const double more = WEIGHT_N / ROTORS + f->climb_N + 1e-3 * ((k / 20 + i) % 3 - 1);
  const double command_N[ROTORS] = {more, more + 1e-4 * i, more, more - 1e-4};
  if (f->pushed && k % 50 == 0) body_push(b, d3(1e-3 * (k % 3), 1e-3 * i, -1e-3));
  if (f->shaken && (i % 3 == 1 || k / 50 % 2))
    body_shake(b, (push_t){{1e-3 * (k % 3), 1e-3 * i, -1e-3}, {1e-6 * i, 1e-6 * (k % 5), 1e-7}});
  body_command(b, command_N, 0.002);
  return true;
}

static void end(flights_t *f, int i, body_t *b) {
  memcpy(f->y[i], b->y, sizeof f->y[i]);
  f->charge[i] = b->charge;
  f->contacts += b->ceiling_contacts;
  body_close(b);
}

static void fly(flights_t *f, int i) {
  static body_t b;
  if (!begin(f, i, &b)) return;
  for (int k = 0; order(f, i, k, &b); k++) {
    body_tick_begin(&b);
    body_tick_alone(&b);
    body_tick_end(&b);
  }
  end(f, i, &b);
}

// What is said of who moved with others is what its body says; who is pushed next is settled before.
static void see(abreast_t *a, int i, bool moved, const lanes_seen_t *seen, double vbat_V, body_t *b) {
  abreast_settle(a, i, b);
  if (!moved) return;
  CHECK(body_rotors_N(b) == seen->rotors_N[i] && body_gap_m(b) == seen->gap_m[i] && b->vbat_V == vbat_V);
}

// What is true, likewise.
static void sense(abreast_t *a, int n, body_t *body) {
  double number[LANES_TRUTH][LANES];
  lanes_truth_t truth = {.number = number[0]};
  const unsigned sensed = abreast_sense(a, &truth);
  for (int i = 0; i < n; i++) {
    if (!(sensed >> i & 1)) continue;
    fx_sensed_t above, below;
    abreast_settle(a, i, &body[i]);
    body_sensed(&body[i], &above, &below);
    const double want[] = {above.acc_b_mps2.x, above.acc_b_mps2.y, above.acc_b_mps2.z, above.range_m,
                           below.range_m};
    for (int k = 0; k < LANES_TRUTH; k++)
      CHECK(number[k][i] == (k < RIGID_THRUST_N ? body[i].y[k] : want[k - RIGID_THRUST_N]));
  }
}

// first to first + n - 1, side by side.
static void fly_beside(flights_t *f, abreast_t *a, int first, int n) {
  static body_t body[LANES];
  abreast_forget(a);
  for (int i = 0; i < n; i++)
    if (!begin(f, first + i, &body[i])) return;
  for (int k = 0, left = n; left > 0; k++) {
    body_t *moves[LANES] = {NULL};
    left = 0;
    for (int i = 0; i < n; i++)
      if (order(f, first + i, k, &body[i])) {
        moves[i] = &body[i];
        left++;
      }
    lanes_seen_t seen;
    double vbat_V[LANES];
    const unsigned moved = abreast_move(a, moves, &seen, vbat_V);
    if (k % 3 == 0) sense(a, n, body);
    for (int i = 0; i < n && (f->pushed || k % 2); i++) see(a, i, moved >> i & 1, &seen, vbat_V[i], &body[i]);
  }
  for (int i = 0; i < n; i++) {
    abreast_settle(a, i, &body[i]);
    end(f, first + i, &body[i]);
  }
}

static long all_beside(flights_t *f, int n) {
  abreast_t *const a = abreast_open(f->bits);
  if (!a) {
    for (int i = 0; i < n; i++) fly(f, i);
    return 0;
  }
  for (int i = 0; i < n; i += LANES) fly_beside(f, a, i, n - i < LANES ? n - i : LANES);
  const long together = abreast_together(a);
  abreast_close(a);
  return together;
}

// Each by all registers that the processor has; together: by the widest.
static long beside_as(const flights_t *as, const flights_t *alone, int *contacts) {
  long together = 0;
  for (int bits = lane_possible() ? 256 : 0; bits <= lane_bits(); bits = bits ? 2 * bits : 1) {
    flights_t beside = *as;
    beside.bits = bits;
    together = all_beside(&beside, FLIGHTS);
    CHECK(memcmp(alone->y, beside.y, sizeof alone->y) == 0);
    CHECK(memcmp(alone->charge, beside.charge, sizeof alone->charge) == 0);
    CHECK(alone->contacts == beside.contacts);
    *contacts += beside.contacts;
  }
  return together;
}

static long same_bits_as(const flights_t *as, int *contacts) {
  long together = 0;
  *contacts = 0;
  for (int kind = INTEGRATE_SUNDIALS; kind <= INTEGRATE_RK4; kind++) {
    flights_t alone = *as, beside = *as;
    alone.kind = beside.kind = (integrate_kind_t)kind;
    for (int i = 0; i < FLIGHTS; i++) fly(&alone, i);
    together += beside_as(&beside, &alone, contacts);
  }
  return together;
}

static long same_bits_of(const model_t *m, const model_t *other, double climb_N, int *contacts) {
  const flights_t as = {.model = m, .other = other, .climb_N = climb_N};
  return same_bits_as(&as, contacts);
}
static long same_bits(const model_t *m, double climb_N, int *contacts) {
  return same_bits_of(m, m, climb_N, contacts);
}

// No list: whoever adds an effect finds it flown here.
TEST(abreast_every_effect_has_the_bits_that_it_has_alone) {
  for (int i = 0; i < fx_count; i++) {
    ROW("%s", fx_table[i]->name);
    model_t m = vehicle6(0.6);
    const fx_use_t use = fx_use(fx_table[i]);
    why_t why;
    int contacts;
    if (!CHECK_OK(model_add_fx(&m, &use, &why))) continue;
    const long together = same_bits(&m, 0.0, &contacts);
    if (lane_possible()) CHECK(together > MOST);
  }
}

TEST(abreast_every_curve_has_the_bits_that_it_has_alone) {
  for (int i = 0; i < curve_count; i++) {
    ROW("%s", curve_table[i]->name);
    const bool ceiling = curve_table[i]->surfaces & SURFACE_CEILING;
    model_t m = vehicle6(0.6);
    fx_use_t use = fx_use(fx_find(ceiling ? "ceiling" : "ground"));
    why_t why;
    int contacts;
    fx_use_form(&use, curve_table[i]);
    if (!CHECK_OK(model_add_fx(&m, &use, &why))) continue;
    (void)same_bits(&m, 0.0, &contacts);
  }
}

// At a branch on a number of their own: here on where the ceiling's distance is taken.
TEST(abreast_who_parts_from_the_others_is_moved_alone_and_has_the_same_bits) {
  model_t m = vehicle6(0.6), other = m;
  fx_use_t use = fx_use(fx_find("ceiling"));
  why_t why;
  int contacts;
  CHECK_OK(model_add_fx(&m, &use, &why));
  use.p[fx_use_kind(&use)] = 0.0;
  CHECK_OK(model_add_fx(&other, &use, &why));
  const long together = same_bits_of(&m, &other, 0.0, &contacts);
  if (lane_possible()) CHECK(together > MOST);
}

TEST(abreast_who_touches_has_the_bits_that_it_has_alone) {
  const model_t m = vehicle6(0.5);
  int contacts;
  const long together = same_bits(&m, 0.02, &contacts);
  CHECK(contacts > 0);
  if (lane_possible()) CHECK(together > 0);
}

static model_t with_effects(const char *const name[3]) {
  model_t m = vehicle6(0.6);
  why_t why;
  for (int k = 0; k < 3 && name[k]; k++) {
    const fx_use_t use = fx_use(fx_find(name[k]));
    CHECK_OK(model_add_fx(&m, &use, &why));
  }
  return m;
}

TEST(abreast_neighbours_that_differ_have_their_own_bits) {
  static const struct {
    const char *what, *model[3], *other[3];
    bool pushed, shaken, held, vertical;
    double other_step_s;
  } rows[] = {
      {.what = "three loads", .model = {"rotor_drag", "body_drag", "flapping"}},
      {.what = "two excesses", .model = {"ceiling", "ground"}},
      {.what = "other loads", .model = {"rotor_drag"}, .other = {"body_drag"}},
      {.what = "other excess", .model = {"ceiling"}, .other = {"ground"}},
      {.what = "one without", .model = {"ceiling", "rotor_drag"}, .other = {"rotor_drag"}},
      {.what = "one ticks", .model = {"rotor_drag"}, .other = {"rotor_drag", "wind"}},
      {.what = "pushed", .model = {"rotor_drag"}, .pushed = true},
      {.what = "shaken", .model = {"rotor_drag"}, .shaken = true},
      {.what = "held", .model = {"rotor_drag"}, .held = true},
      {.what = "on the vertical axis", .model = {"rotor_drag"}, .vertical = true},
      {.what = "a finer step", .model = {"ceiling"}, .other_step_s = 0.001},
  };
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    ROW("%s", rows[i].what);
    int contacts;
    const model_t m = with_effects(rows[i].model);
    const model_t other = rows[i].other[0] ? with_effects(rows[i].other) : m;
    const flights_t as = {.model = &m,
                          .other = &other,
                          .pushed = rows[i].pushed,
                          .shaken = rows[i].shaken,
                          .held = rows[i].held,
                          .vertical = rows[i].vertical,
                          .other_step_s = rows[i].other_step_s};
    (void)same_bits_as(&as, &contacts);
  }
}

TEST(abreast_who_lags_otherwise_has_its_own_bits) {
  model_t m = vehicle6(0.6), other = m, squared = m;
  other.lag_in_speed = squared.lag_in_speed = true;
  squared.lag_square[1] = 1.0;
  int contacts;
  (void)same_bits_of(&m, &other, 0.0, &contacts);
  (void)same_bits_of(&other, &squared, 0.0, &contacts);
}

TEST(abreast_measured_points_have_the_bits_that_they_have_alone) {
  model_t m = vehicle6(0.6), other = m;
  fx_use_t use = fx_use(fx_find("ceiling"));
  why_t why;
  int contacts;
  fx_use_form(&use, curve_find("table"));
  use.points = (curve_points_t){.n = 3, .x = {0.0, 5.0, 30.0}, .ratio = {1.4, 1.1, 1.0}};
  CHECK_OK(model_add_fx(&m, &use, &why));
  use.points.ratio[1] = 1.2;
  CHECK_OK(model_add_fx(&other, &use, &why));
  (void)same_bits_of(&m, &other, 0.0, &contacts);
}

TEST(abreast_so_few_that_it_costs_are_moved_alone) {
  const model_t m = vehicle6(0.6);
  for (int n = 1; n <= LANES; n++) {
    ROW("%d", n);
    flights_t f = {.model = &m, .other = &m, .kind = INTEGRATE_SUNDIALS, .bits = lane_bits()};
    const long together = all_beside(&f, n);
    CHECK((together > 0) == (lane_possible() && n >= ABREAST_FEWEST));
  }
}

// Of the registers that hold lanes nothing is in use beyond what plain code has of them (XGETBV with 1: the
// state components in use; number 2 is their upper halves). True where the processor does not say it.
static bool upper_halves_are_clean(void) {
#ifdef __x86_64__
  unsigned has = 0xd, b, leaf = 1, d, used, high;
  __asm__ volatile("cpuid" : "+a"(has), "=b"(b), "+c"(leaf), "=d"(d));
  if (!(has >> 2 & 1)) return true;
  __asm__ volatile("xgetbv" : "=a"(used), "=d"(high) : "c"(1));
  return !(used >> 2 & 1);
#else
  return true;
#endif
}

static void leave_each_way(const lanes_door_t *door, const body_t *b) {
  _Alignas(64) double y[RIGID_N * LANES] = {0.0}, dydt[RIGID_N * LANES], is[LANES_TRUTH * LANES];
  const lanes_alike_t alike = lanes_alike(b);
  const fx_use_t use = fx_use(fx_find("rotor_drag"));
  const lanes_effect_t drag = lanes_effect(&use);
  const lanes_instants_t at = {.y = {{0.0}}};
  const lanes_sight_t sight = {.range_m = {0.0}};
  lanes_t *const l = lanes_open(door);
  void *const kept = aligned_alloc(64, (door->kept_bytes() + 63) / 64 * 64);
  lanes_seen_t seen;
  lanes_gap_t gap;
  lanes_readings_t read;
  lanes_truth_t truth = {.number = is};
  double up[LANES];
  if (!l || !kept) abort();
  door->begin(0xff);
#define LEAVES(what) ((what), CHECK(upper_halves_are_clean()))
  LEAVES(door->set(l, &alike));
  LEAVES(door->tick(l));
  LEAVES(door->derivative(l, y, dydt));
  LEAVES(door->gap(l, &gap));
  LEAVES(door->end(l, &seen));
  LEAVES(door->sense(l, &truth));
  LEAVES(door->look(l, &at, up));
  LEAVES(door->read(l, &sight, &read));
  LEAVES(door->keep(l, kept));
  LEAVES(door->read_again(l, kept, true, &read));
  LEAVES(door->read_more(l, &drag, kept, &read));
#undef LEAVES
  free(kept);
  door->close(l);
}

// Else each plain instruction waits for them (base/lane_leave.hpp).
TEST(abreast_who_leaves_the_lanes_leaves_their_registers_clean) {
  const model_t m = vehicle6(0.6);
  const body_start_t start = {.pos_w_m = {0.0, 0.0, 0.3}};
  body_t b;
  CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start));
  b.span_s = 0.002;
  for (int bits = 256; bits <= lane_bits(); bits += 256) {
    ROW("%d", bits);
    leave_each_way(lanes_door(bits), &b);
  }
  body_close(&b);
}
