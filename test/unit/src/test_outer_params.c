// test_outer_params.c - parameters of the outer loop that change in flight, good ones and bad ones.
#include "rig/rig3.h"
#include "rig/test.h"

#include <string.h>

TEST(outer_keeps_the_last_good_parameters) {
  // Faults rows 31, 32: the twin never sees the bad set.
  static const float bad[] = {NAN, INFINITY, -INFINITY, 1e9f, -1e9f};
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  for (int i = 0; i < params_count; i++)
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%s = %g", params_table[i].name, (double)bad[k]);
      outer_t f, twin;
      memcpy(&f, &start, sizeof f);
      memcpy(&twin, &start, sizeof twin);
      flight_param_t absurd = p;
      memcpy((char *)&absurd + params_table[i].offset, &bad[k], sizeof(float));
      rig3_t there = v;
      for (int tick = 0; tick < 6; tick++) {
        const outer_in_t in = rig3_sense(&there, (v3_t){0.02f, 0, 0.93f});
        const outer_out_t out = rig3_step(&f, tick < 3 ? &absurd : &p, &in);
        const outer_out_t want = rig3_step(&twin, &p, &in);
        CHECK(rig3_same_out(&out, &want));
        rig3_move(&there, &want);
      }
      CHECK(rig3_same_state(&f, &twin));
      CHECK(f.faults[ST_BAD_PARAM] == start.faults[ST_BAD_PARAM] + 3);
    }
}

TEST(outer_refuses_a_cut_off_beyond_nyquist_in_flight) {
  flight_param_t p = rig3_param();
  p.cutoff_Hz = 2.0f;
  outer_t f;
  CHECK_OK(outer_init(&f, &p, 0.1f));
  flight_param_t fast = p;
  fast.cutoff_Hz = 8.0f; // in its range, but not at 10 Hz
  rig3_t v = rig3_at(0, 0, 0.5, RIG3_NO_CEILING);
  const outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.5f});
  (void)rig3_step(&f, &fast, &in);
  CHECK(f.faults[ST_BAD_PARAM] == 1);
  CHECK(f.param.cutoff_Hz == 2.0f);
}

TEST(outer_takes_a_good_set_over_at_once) {
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  static const struct {
    const char *name;
    float value;
    int32_t law;
  } row[] = {{"indiPos.kp", 2, LAW_PREDICTED},
             {"indiPos.kd", 8, LAW_PREDICTED},
             {"indiPos.kpz", 3, LAW_PREDICTED},
             {"indiPos.kdz", 5, LAW_PREDICTED},
             {"indiPos.quick", 2, LAW_PREDICTED},
             {"indiPos.cutoff", 20, LAW_PREDICTED},
             {"indiPos.tauMot", 0.1f, LAW_PREDICTED},
             {"indiPos.mass", 0.04f, LAW_PREDICTED},
             {"ceil.mode", 0, LAW_PREDICTED},
             {"ceil.law", LAW_THESIS, LAW_PREDICTED},
             {"ceil.kz", 2, LAW_THESIS},
             {"ceil.catch", 0.2f, LAW_PREDICTED},
             {"ceil.zOn", 0.01f, LAW_PREDICTED}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    p.curve.mode = CURVE_THEORY; // the learned curve may be flat here
    p.pos.law = row[i].law;
    flight_param_t changed = p;
    CHECK_OK(params_set(&changed, params_find(row[i].name), row[i].value));
    outer_in_t in = rig3_sense(&v, (v3_t){0.1f, 0, 0.93f});
    in.vel_w_mps.z = 0.05f;
    in.thrust_N += 0.02f;
    const outer_out_t out = rig3_step(&f, &changed, &in);
    const outer_out_t before = rig3_step(&twin, &p, &in);
    CHECK(!rig3_same_out(&out, &before));
    CHECK(memcmp(&f.param, &changed, sizeof changed) == 0);
    CHECK(f.faults[ST_BAD_PARAM] == 0);
  }
}

TEST(outer_init_refuses_what_cannot_fly) {
  static const struct {
    const char *what;
    float period_s, cutoff_Hz;
    int32_t mode;
  } row[] = {
      {"period zero", 0.0f, 8, 1},         {"period negative", -0.01f, 8, 1},
      {"period nan", NAN, 8, 1},           {"period too long", 0.11f, 1, 1},
      {"period too short", 0.0009f, 8, 1}, {"cut-off beyond nyquist", 0.1f, 8, 1},
      {"cut-off nan", 0.01f, NAN, 1},      {"no such mode", 0.01f, 8, 7},
  };
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    outer_t f;
    memcpy(&f, &start, sizeof f);
    flight_param_t bad = rig3_param();
    bad.cutoff_Hz = row[i].cutoff_Hz;
    bad.curve.mode = row[i].mode;
    CHECK_STATUS(ST_BAD_PARAM, outer_init(&f, &bad, row[i].period_s));
    CHECK(memcmp(&f, &start, sizeof f) == 0);
  }
}
