// test_estimator.c - the vertical Kalman filter and the noise of the sensors.
#include "rig/oracle.h"
#include "rig/test.h"
#include "sense/kalman_z.h"
#include "sense/vertical.h"
#include <string.h>

TEST(kalman_gains_are_those_of_the_prototype) {
  kalman_z_t k;
  kalman_z_init(&k, 0.5, 0.0025, 0.01, 2, 0.3);
  CHECK_NEAR(k.k_z, 0.28556, 5e-5);
  CHECK_NEAR(k.k_v, 2.3907, 5e-4);
  CHECK(k.z_m == 0.3 && k.climb_mps == 0.0);
}

TEST(kalman_follows_a_climb_without_error) {
  kalman_z_t k;
  kalman_z_init(&k, 0.5, 0.001, 0.01, 2, 0.0);
  for (int tick = 1; tick <= 1000; tick++) {
    kalman_z_predict(&k, 0.0, 0.01);
    if (tick % 2 == 0) kalman_z_correct(&k, 0.2 * 0.01 * tick);
  }
  CHECK_NEAR(k.z_m, 2.0, 1e-9);
  CHECK_NEAR(k.climb_mps, 0.2, 1e-9);
}

TEST(accelerometer_bias_becomes_a_bias_of_climb_and_height) {
  // Steady state of the two-state filter: the correction of two ticks undoes what the bias adds in them.
  kalman_z_t k;
  kalman_z_init(&k, 0.5, 0.001, 0.01, 2, 0.0);
  for (int tick = 1; tick <= 4000; tick++) {
    kalman_z_predict(&k, 0.1, 0.01);
    if (tick % 2 == 0) kalman_z_correct(&k, 0.0);
  }
  const double innovation_m = -0.1 * 0.02 / k.k_v;
  CHECK_NEAR(k.z_m, -(1.0 - k.k_z) * innovation_m, 1e-9);
  CHECK(k.climb_mps > 0.005); // it believes that it climbs: the height error of thesis C.3 grows by this
}

TEST(upward_sensor_has_a_floor_and_says_nothing_beyond_its_reach) {
  static const struct {
    double gap_m, range_m;
  } row[] = {{1.0, 1.0}, {0.04, 0.04}, {0.02, 0.04}, {0.0, 0.04}, {4.5, 32.767}, {(double)INFINITY, 32.767}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].gap_m);
    CHECK(vertical_up_m(&vertical_noise_levels[0], NULL, row[i].gap_m) == row[i].range_m);
  }
}

TEST(noise_comes_from_the_generator_of_the_library_number_for_number) {
  static double want[2000];
  static const uint64_t seeds[] = {0, 1, 5489, UINT64_MAX};
  for (int k = 0; k < 4; k++) {
    oracle_uniform(seeds[k], 2000, want);
    random_t *r = random_open(seeds[k]);
    int same = 0;
    for (int i = 0; i < 2000; i++) same += random_uniform(r, 0.0, 1.0) == want[i];
    ROW("seed %d", k);
    CHECK(same == 2000);
    random_close(r);
  }
}

// One by one and many at once, odd and even, so that the second one of a pair is left over, and not.
TEST(normal_noise_is_that_of_the_library_number_for_number_alone_and_many_at_once) {
  enum { ALL = 20000, MOST = 70 };
  static double want[ALL + MOST], got[ALL + MOST];
  static const uint64_t seeds[] = {0, 1, 5489, UINT64_MAX};
  for (int k = 0; k < 4; k++) {
    oracle_normal(seeds[k], ALL, want);
    random_t *r = random_open(seeds[k]);
    for (int i = 0, many = 0; i < ALL; many = (many + 1) % MOST) {
      if (many == 1)
        got[i] = random_normal(r);
      else
        random_normals(r, many, got + i);
      i += many;
    }
    ROW("seed %d", k);
    CHECK(memcmp(got, want, ALL * sizeof *want) == 0);
    random_close(r);
  }
}

TEST(noise_has_the_stated_size_and_the_same_seed_the_same_numbers) {
  const vertical_noise_t n2 = vertical_noise_levels[2];
  random_t *a = random_open(7), *b = random_open(7), *c = random_open(8);
  vertical_t one, two;
  vertical_init(&one, &n2, 0.01, 0.0);
  vertical_init(&two, &n2, 0.01, 0.0);
  double sum2 = 0.0, product = 0.0, gust = 0.0;
  bool same = true;
  for (int i = 0; i < 200000; i++) {
    const double before = gust;
    gust = vertical_gust_mps2(&one, &n2, a);
    same = same && gust == vertical_gust_mps2(&two, &n2, b);
    sum2 += gust * gust;
    product += gust * before;
  }
  CHECK(same);
  CHECK(random_normal(a) != random_normal(c));
  CHECK_NEAR(sqrt(sum2 / 200000), 0.05, 0.003); // 3 standard errors at 3,300 independent samples
  CHECK_NEAR(product / sum2, exp(-0.01 / 0.3), 0.002);
  random_close(a);
  random_close(b);
  random_close(c);
}
