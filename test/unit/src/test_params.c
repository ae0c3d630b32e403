// test_params.c - the one table of tunable numbers.
#include "flight/params.h"
#include "rig/test.h"

#include <float.h>
#include <limits.h>
#include <string.h>

static flight_param_t defaults(void) {
  flight_param_t p;
  params_default(&p);
  return p;
}

static bool same(const flight_param_t *a, const flight_param_t *b) {
  return memcmp(a, b, sizeof *a) == 0;
}

// Writes past all checks, as a flipped bit or a foreign thread would.
static void poke(flight_param_t *p, const param_row_t *row, float value) {
  const int32_t whole = value >= 2147483520.0f    ? INT32_MAX
                        : value >= -2147483520.0f ? (int32_t)value
                                                  : INT32_MIN; // NaN too
  memcpy((char *)p + row->offset, row->type == PARAM_INT ? (const void *)&whole : (const void *)&value, 4);
}

TEST(params_defaults_are_in_their_ranges_and_pass_the_check) {
  const flight_param_t p = defaults();
  CHECK_OK(params_check(&p));
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    ROW("%s", row->name);
    CHECK(row->min < row->max);
    CHECK(row->initial >= row->min && row->initial <= row->max);
    CHECK(params_get(&p, row) == row->initial);
    CHECK(row->help && row->help[0] && row->unit);
  }
}

TEST(params_names_fit_the_firmware_and_are_unique) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    ROW("%s", row->name);
    CHECK(strlen(row->name) <= 26);
    const char *dot = strchr(row->name, '.');
    CHECK(dot && dot > row->name && dot[1] && !strchr(dot + 1, '.'));
    CHECK(strspn(row->name, ".abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789") ==
          strlen(row->name));
    CHECK(params_find(row->name) == row); // the first of its name
    for (int k = 0; k < i; k++) CHECK(params_table[k].offset != row->offset);
  }
}

static const struct {
  const char *name, *unit;
  float initial;
} RELIED_ON[] = {
    {"indiPos.kp", "1/s", 0.5f},
    {"indiPos.kd", "1/s", 4},
    {"indiPos.kpz", "1/s", 2},
    {"indiPos.kdz", "1/s", 8},
    {"indiPos.quick", "", 3.1f},
    {"indiPos.cutoff", "Hz", 30},
    {"indiPos.tauMot", "s", 0.08f},
    {"indiPos.mass", "kg", 0.0329f},
    {"ceil.mode", "", 1},
    {"ceil.ca", "", 0.44f},
    {"ceil.cb", "1/m", 80},
    {"ceil.law", "", 1},
    {"ceil.kz", "s", 0.3f},
    {"ceil.catch", "s", 0.08f},
    {"ceil.hold", "", 2},
    {"ceil.push", "N", 0.05f},
    {"ceil.zOn", "m", 0.1f},
    {"ceil.gain", "", 0.1f},
    {"ceil.near", "m", 0.05f},
    {"ceil.clip", "", 1},
    // Least squares to the theory, as the author's branch has them.
    {"ceil.w1", "", 1.43142386f},
    {"ceil.w2", "", 0.15021046f},
    {"ceil.w3", "", -0.09754395f},
    {"ceil.w4", "", -0.07601899f},
    {"ceil.w5", "", -0.26694495f},
    {"ceil.w6", "", -0.30407099f},
    {"ceil.w7", "", -0.37406497f},
    {"rls.form", "", 1},
    {"rls.lambda", "", 1},
    {"rls.p0", "", 10},
    {"rls.q", "", 1e-6f},
};

TEST(params_that_the_outside_relies_on_are_there) {
  for (unsigned i = 0; i < sizeof RELIED_ON / sizeof *RELIED_ON; i++) {
    ROW("%s", RELIED_ON[i].name);
    const param_row_t *found = params_find(RELIED_ON[i].name);
    if (!CHECK(found != NULL)) continue;
    CHECK_TEXT(found->unit, RELIED_ON[i].unit);
    CHECK(found->initial == RELIED_ON[i].initial);
  }
  const flight_param_t p = defaults();
  for (int k = 0; k < RBF_N; k++) {
    ROW("w%d is the curve's", k + 1);
    CHECK(p.curve.fixed.w[k] == RELIED_ON[20 + k].initial);
  }
}

TEST(params_find_knows_only_what_is_there) {
  static const char *const name[] = {"",          "ceil",       "ceil.",   ".mode",
                                     "ceil.Mode", "ceil.mode ", "ceil.w8", "mode"};
  for (unsigned i = 0; i < sizeof name / sizeof *name; i++) {
    ROW("`%s`", name[i]);
    CHECK(params_find(name[i]) == NULL);
  }
}

TEST(params_set_changes_one_number_and_no_other) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    const float value[] = {row->min, row->max, row->initial};
    for (int k = 0; k < 3; k++) {
      ROW("%s = %g", row->name, (double)value[k]);
      flight_param_t p = defaults(), want = p;
      CHECK_OK(params_set(&p, row, value[k]));
      CHECK(params_get(&p, row) == value[k]);
      poke(&want, row, value[k]);
      CHECK(same(&p, &want));
    }
  }
}

TEST(params_set_refuses_what_is_out_of_range_and_changes_nothing) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    const float bad[] = {NAN,
                         INFINITY,
                         -INFINITY,
                         FLT_MAX,
                         -FLT_MAX,
                         nextafterf(row->min, -FLT_MAX),
                         nextafterf(row->max, FLT_MAX)};
    flight_param_t p = defaults();
    const flight_param_t before = p;
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%s = %g", row->name, (double)bad[k]);
      CHECK_STATUS(ST_BAD_PARAM, params_set(&p, row, bad[k]));
    }
    if (row->type == PARAM_INT) {
      ROW("%s, a fraction", row->name);
      CHECK_STATUS(ST_BAD_PARAM, params_set(&p, row, 0.5f * (row->min + row->max) + 0.25f));
    }
    CHECK(same(&p, &before));
  }
}

TEST(params_check_finds_every_number_out_of_range) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *row = &params_table[i];
    const float bad[] = {NAN, INFINITY, -INFINITY, 1e9f, -1e9f, row->min - 1.0f, row->max + 1.0f};
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%s = %g", row->name, (double)bad[k]);
      flight_param_t p = defaults();
      poke(&p, row, bad[k]);
      CHECK_STATUS(ST_BAD_PARAM, params_check(&p));
    }
  }
}

TEST(params_check_finds_numbers_that_contradict_each_other) {
  static const struct {
    const char *what, *name[2];
    float value[2];
    status_t want;
  } row[] = {
      {"no distance to learn from", {"rls.zMin", "rls.zMax"}, {0.1f, 0.05f}, ST_BAD_PARAM},
      {"one distance to learn from", {"rls.zMin", "rls.zMax"}, {0.05f, 0.05f}, ST_BAD_PARAM},
      {"a millimetre to learn from", {"rls.zMin", "rls.zMax"}, {0.05f, 0.051f}, ST_OK},
      {"walk as large as the start", {"rls.q", "rls.p0"}, {1e-3f, 1e-3f}, ST_OK},
      {"no filter at all", {"indiPos.cutoff", "indiAtt.cutoff"}, {0.0f, 0.0f}, ST_OK},
      {"cut-offs at their least", {"indiPos.cutoff", "indiAtt.cutoff"}, {0.1f, 0.5f}, ST_OK},
      {"outer cut-off below its least", {"indiPos.cutoff", "indiAtt.cutoff"}, {0.0999f, 0.0f}, ST_BAD_PARAM},
      {"inner cut-off below its least", {"indiPos.cutoff", "indiAtt.cutoff"}, {0.0f, 0.499f}, ST_BAD_PARAM},
      {"floor beyond the gate", {"ceil.floor", "ceil.near"}, {0.06f, 0.05f}, ST_BAD_PARAM},
      {"floor at the gate", {"ceil.floor", "ceil.near"}, {0.05f, 0.05f}, ST_OK},
      {"gate far out, ceiling near", {"ceil.near", "ceil.far"}, {0.2f, 0.25f}, ST_OK},
      {"bounds of the ratio meet", {"ceil.ratioMin", "ceil.ratioMax"}, {1.0f, 1.0f}, ST_OK},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_param_t p = defaults();
    for (int k = 0; k < 2; k++) CHECK_OK(params_set(&p, params_find(row[i].name[k]), row[i].value[k]));
    CHECK_STATUS(row[i].want, params_check(&p));
  }
}

TEST(params_that_have_to_be_in_order_are_so_by_their_ranges) {
  static const struct {
    const char *less, *more;
    bool may_meet;
  } row[] = {
      {"rls.q", "rls.p0", true}, {"ceil.near", "ceil.far", false}, {"ceil.ratioMin", "ceil.ratioMax", true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].less);
    const float most = params_find(row[i].less)->max, least = params_find(row[i].more)->min;
    CHECK(row[i].may_meet ? most <= least : most < least);
  }
}
