// test_trajectory.c - pieces of polynomials, and rows of them.
#include "crazyflie/trajectory.h"
#include "rig/test.h"
#include <string.h>

static const goal_t FROM = {{0.1f, -0.2f, 0.3f, 0.4f}, {0.5f, 0.0f, -0.1f, 0.2f}, {0.3f, 0.1f, 0.0f, 0.0f}};
static const goal_t TO = {{1.0f, 0.6f, 1.2f, -0.5f}, {0.0f, 0.3f, 0.1f, 0.0f}, {0.0f, -0.2f, 0.4f, 0.0f}};

static void check_goal(const goal_t *got, const goal_t *want, double tol) {
  for (int i = 0; i < TRAJECTORY_AXES; i++) {
    CHECK_NEAR(got->at[i], want->at[i], tol);
    CHECK_NEAR(got->speed[i], want->speed[i], tol);
    CHECK_NEAR(got->acc[i], want->acc[i], 10.0 * tol);
  }
}

TEST(a_piece_begins_and_ends_as_it_was_asked_to) {
  static const float durations_s[] = {0.5f, 2.0f, 7.0f};
  for (int i = 0; i < 3; i++) {
    ROW("%g s", (double)durations_s[i]);
    const piece_t piece = piece_between(&FROM, &TO, durations_s[i]);
    const goal_t begin = piece_at(&piece, 0.0f), end = piece_at(&piece, durations_s[i]);
    check_goal(&begin, &FROM, 1e-6);
    check_goal(&end, &TO, 2e-4); // of floats, with powers up to the seventh
  }
  const piece_t at_once = piece_between(&FROM, &TO, 0.0f);
  const goal_t there = piece_at(&at_once, 0.0f);
  check_goal(&there, &TO, 1e-6);
}

TEST(a_piece_has_no_jerk_at_its_ends_and_slopes_that_are_its_differences) {
  const piece_t piece = piece_between(&FROM, &TO, 2.0f);
  CHECK_NEAR(piece.c[TRAJECTORY_X][3], 0.0, 0.0);
  for (float t = 0.2f; t < 1.9f; t += 0.3f) {
    const goal_t a = piece_at(&piece, t - 0.01f), b = piece_at(&piece, t + 0.01f), m = piece_at(&piece, t);
    for (int i = 0; i < TRAJECTORY_AXES; i++) {
      CHECK_NEAR((b.at[i] - a.at[i]) / 0.02f, m.speed[i], 2e-3);
      CHECK_NEAR((b.speed[i] - a.speed[i]) / 0.02f, m.acc[i], 5e-3);
    }
  }
}

#define PIECES 2
static trajectory_t two(uint8_t memory[PIECES * TRAJECTORY_PIECE_BYTES]) {
  const goal_t middle = {{0.5f, 0.5f, 0.5f, 0.0f}, {0.1f, 0.1f, 0.1f, 0.0f}, {0.0f}};
  const piece_t piece[PIECES] = {piece_between(&FROM, &middle, 1.0f), piece_between(&middle, &TO, 2.0f)};
  memcpy(memory, piece, PIECES * TRAJECTORY_PIECE_BYTES);
  return (trajectory_t){
      .memory = memory, .size = PIECES * TRAJECTORY_PIECE_BYTES, .n_piece = PIECES, .timescale = 1.0f};
}

TEST(a_trajectory_is_stretched_turned_shifted_and_flown_backwards) {
  uint8_t memory[PIECES * TRAJECTORY_PIECE_BYTES];
  trajectory_t t = two(memory);
  goal_t plain, other;
  CHECK(trajectory_at(&t, 1.5f, &plain));
  CHECK_NEAR(trajectory_duration_s(&t), 3.0, 1e-6);
  t.timescale = 2.0f;
  CHECK(trajectory_at(&t, 3.0f, &other));
  CHECK_NEAR(other.at[0], plain.at[0], 1e-6);
  CHECK_NEAR(other.speed[0], plain.speed[0] / 2.0f, 1e-6);
  CHECK_NEAR(trajectory_duration_s(&t), 6.0, 1e-6);
  t = two(memory);
  t.turn_rad = 1.5707963f;
  t.shift_m[2] = 1.0f;
  CHECK(trajectory_at(&t, 1.5f, &other));
  CHECK_NEAR(other.at[0], -plain.at[1], 1e-6);
  CHECK_NEAR(other.at[1], plain.at[0], 1e-6);
  CHECK_NEAR(other.at[2], plain.at[2] + 1.0f, 1e-6);
  CHECK_NEAR(other.at[3], plain.at[3] + 1.5707963f, 1e-6);
  t = two(memory);
  t.reversed = true;
  CHECK(trajectory_at(&t, 1.5f, &other)); // from the end: 3.0 - 1.5
  CHECK_NEAR(other.at[0], plain.at[0], 1e-5);
  CHECK_NEAR(other.speed[0], -plain.speed[0], 1e-5);
}

TEST(a_trajectory_stands_where_it_ends) {
  uint8_t memory[PIECES * TRAJECTORY_PIECE_BYTES];
  const trajectory_t t = two(memory);
  goal_t end;
  CHECK(trajectory_at(&t, 100.0f, &end));
  CHECK_NEAR(end.at[0], TO.at[0], 1e-4);
  CHECK(end.speed[1] == 0.0f && end.acc[1] == 0.0f);
}

// 0 0 0 0; a second to x = 1 m straight, y along a Bezier curve of three more points; the end.
static const uint8_t COMPRESSED[] = {0,    0,    0,    0,    0,    0,    0,    0,    1 | 2 << 2, 0xe8, 0x03,
                                     0xe8, 0x03, 0x64, 0x00, 0x64, 0x00, 0xc8, 0x00, 0,          0,    0};

TEST(a_compressed_trajectory_is_unpacked) {
  const trajectory_t t = {
      .memory = COMPRESSED, .size = sizeof COMPRESSED, .compressed = true, .timescale = 1.0f};
  goal_t goal;
  CHECK(trajectory_at(&t, 0.5f, &goal));
  CHECK_NEAR(goal.at[0], 0.5, 1e-6);
  CHECK_NEAR(goal.speed[0], 1.0, 1e-6);
  CHECK_NEAR(goal.at[1], 0.1 * 3 / 8 + 0.1 * 3 / 8 + 0.2 / 8, 1e-6); // Bernstein's weights in the middle
  CHECK(trajectory_at(&t, 2.0f, &goal));
  CHECK_NEAR(goal.at[0], 1.0, 1e-6);
  CHECK_NEAR(goal.at[1], 0.2, 1e-6);
  CHECK_NEAR(trajectory_duration_s(&t), 1.0, 1e-6);
}

TEST(a_trajectory_that_its_memory_does_not_hold_is_none) {
  uint8_t memory[PIECES * TRAJECTORY_PIECE_BYTES];
  goal_t goal;
  for (size_t size = 0; size < sizeof COMPRESSED; size++) {
    ROW("cut after %zu bytes", size);
    const trajectory_t t = {.memory = COMPRESSED, .size = size, .compressed = true, .timescale = 1.0f};
    CHECK(!trajectory_at(&t, 5.0f, &goal));
  }
  trajectory_t t = two(memory);
  t.size--;
  CHECK(!trajectory_at(&t, 0.0f, &goal));
  t = two(memory);
  t.timescale = 0.0f;
  CHECK(!trajectory_at(&t, 0.0f, &goal));
  memset(memory, 0xff, sizeof memory); // no numbers
  t.timescale = 1.0f;
  CHECK(!trajectory_at(&t, 0.0f, &goal));
}
