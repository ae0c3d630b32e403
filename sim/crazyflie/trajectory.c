// trajectory.c - trajectories of the high-level commander.
#include "trajectory.h"

#include <math.h>
#include <string.h>

#define N TRAJECTORY_COEFFICIENTS

// --- one piece --------------------------------------------------------------------------------------------

// h, v and a: position, velocity and acceleration at the end, less those of the start flown on at its
// acceleration, with the duration as unit of time. To make them up with no jerk at either end, the piece
// adds, at share u of the duration,
//
//   u^4 (35 h - 15 v + 5/2 a) + u^5 (-84 h + 39 v - 7 a) +
//   u^6 (70 h - 34 v + 13/2 a) + u^7 (-20 h + 10 v - 2 a)
static void between(float c[N], float T, const float from[3], const float to[3]) {
  memset(c, 0, N * sizeof *c);
  c[0] = from[0], c[1] = from[1], c[2] = from[2] / 2.0f;
  const float h = to[0] - from[0] - T * (from[1] + T * from[2] / 2.0f);
  const float v = T * (to[1] - from[1] - T * from[2]), a = T * T * (to[2] - from[2]);
  float power = T * T * T * T;
  const float in_u[] = {35.0f * h - 15.0f * v + 2.5f * a, -84.0f * h + 39.0f * v - 7.0f * a,
                        70.0f * h - 34.0f * v + 6.5f * a, -20.0f * h + 10.0f * v - 2.0f * a};
  for (int i = 0; i < 4; i++, power *= T) c[4 + i] = in_u[i] / power;
}

piece_t piece_between(const goal_t *from, const goal_t *to, float duration_s) {
  piece_t piece = {.duration_s = duration_s};
  for (int i = 0; i < TRAJECTORY_AXES; i++) {
    const bool yaw = i == TRAJECTORY_YAW;
    const float begin[] = {from->at[i], from->speed[i], yaw ? 0.0f : from->acc[i]};
    const float end[] = {to->at[i], to->speed[i], yaw ? 0.0f : to->acc[i]};
    if (duration_s > 0.0f)
      between(piece.c[i], duration_s, begin, end);
    else
      piece.c[i][0] = end[0], piece.c[i][1] = end[1], piece.c[i][2] = end[2] / 2.0f;
  }
  return piece;
}

goal_t piece_at(const piece_t *piece, float t_s) {
  goal_t goal;
  for (int i = 0; i < TRAJECTORY_AXES; i++) {
    const float *const c = piece->c[i];
    float at = 0.0f, speed = 0.0f, acc = 0.0f;
    for (int k = N - 1; k >= 0; k--) {
      acc = acc * t_s + 2.0f * speed; // Horner, of the polynomial and its derivatives
      speed = speed * t_s + at;
      at = at * t_s + c[k];
    }
    goal.at[i] = at, goal.speed[i] = speed, goal.acc[i] = acc;
  }
  return goal;
}

// --- compressed pieces ------------------------------------------------------------------------------------

// Format: four start values, then pieces. A piece has a byte with two bits an axis that say how many control
// points of a Bezier curve follow (points_of; the first point is the end of the piece before), its duration
// in ms, and the points of x, y, z and yaw. Numbers have 16 bits, lengths in mm, angles in tenths of a
// degree. A piece of 0 ms is the end.
#define START_BYTES 8
#define ANGLE_UNIT  (1800.0f / 3.14159265f)

static const int points_of[] = {0, 1, 3, 7};

typedef struct {
  const uint8_t *memory;
  size_t at, size;
  float end[TRAJECTORY_AXES]; // of the piece before
} reel_t;

static float value(reel_t *r, int axis) {
  const int16_t raw = (int16_t)(r->memory[r->at] | r->memory[r->at + 1] << 8);
  r->at += 2;
  return (float)raw / (axis == TRAJECTORY_YAW ? ANGLE_UNIT : 1000.0f);
}

static bool reel_open(reel_t *r, const trajectory_t *trajectory) {
  *r = (reel_t){.memory = trajectory->memory, .size = trajectory->size};
  if (r->size < START_BYTES) return false;
  for (int i = 0; i < TRAJECTORY_AXES; i++) r->end[i] = value(r, i);
  return true;
}

// Converts a Bezier curve of degree n, control points x, duration T, to powers of the seconds.
static void from_bezier(float c[N], const float *x, int n, float T) {
  memset(c, 0, N * sizeof *c);
  float over = 1.0f, falling = 1.0f; // j! T^j, n (n-1) .. (n-j+1)
  for (int j = 0; j <= n; j++) {
    float sum = 0.0f, choose = 1.0f; // binomial coefficient, j over i
    for (int i = 0; i <= j; i++) {
      sum += ((i + j) % 2 ? -choose : choose) * x[i];
      choose = choose * (float)(j - i) / (float)(i + 1);
    }
    c[j] = falling * sum / over;
    over *= T * (float)(j + 1);
    falling *= (float)(n - j);
  }
}

// Reads the next piece, of 0 s at the end. False: the memory ends before it.
static bool reel_next(reel_t *r, piece_t *piece) {
  *piece = (piece_t){.duration_s = 0.0f};
  for (int i = 0; i < TRAJECTORY_AXES; i++) piece->c[i][0] = r->end[i];
  if (r->at + 3 > r->size) return false;
  const unsigned kinds = r->memory[r->at];
  const unsigned ms = r->memory[r->at + 1] | (unsigned)r->memory[r->at + 2] << 8;
  r->at += 3;
  if (ms == 0) return true;
  piece->duration_s = (float)ms / 1000.0f;
  for (int i = 0; i < TRAJECTORY_AXES; i++) {
    const int n = points_of[kinds >> 2 * i & 3];
    float x[N] = {r->end[i]};
    if (r->at + 2 * (size_t)n > r->size) return false;
    for (int k = 1; k <= n; k++) x[k] = value(r, i);
    from_bezier(piece->c[i], x, n, piece->duration_s);
    r->end[i] = x[n];
  }
  return true;
}

static bool reel_at(const trajectory_t *trajectory, float t_s, goal_t *goal, float *duration_s) {
  reel_t reel;
  if (!reel_open(&reel, trajectory)) return false;
  for (piece_t piece; reel_next(&reel, &piece);) {
    if (piece.duration_s == 0.0f || t_s < piece.duration_s) {
      *goal = piece_at(&piece, piece.duration_s == 0.0f ? 0.0f : t_s);
      return true;
    }
    t_s -= piece.duration_s;
    *duration_s += piece.duration_s;
  }
  return false;
}

// --- pieces one after the other ---------------------------------------------------------------------------

static piece_t piece_of(const trajectory_t *t, int i) {
  piece_t piece;
  memcpy(&piece, t->memory + (size_t)i * TRAJECTORY_PIECE_BYTES, TRAJECTORY_PIECE_BYTES);
  return piece;
}

static void slow_down(goal_t *goal, float timescale) {
  for (int i = 0; i < TRAJECTORY_AXES; i++) {
    goal->speed[i] /= timescale;
    goal->acc[i] /= timescale * timescale;
  }
}

static void stop(goal_t *goal) {
  memset(goal->speed, 0, sizeof goal->speed);
  memset(goal->acc, 0, sizeof goal->acc);
}

// t_s: in the trajectory's own time, before the timescale.
static goal_t pieces_at(const trajectory_t *t, float t_s) {
  piece_t piece = {.duration_s = 0.0f};
  for (int k = 0; k < t->n_piece; k++) {
    piece = piece_of(t, t->reversed ? t->n_piece - 1 - k : k);
    if (t_s <= piece.duration_s) {
      goal_t goal = piece_at(&piece, t->reversed ? piece.duration_s - t_s : t_s);
      for (int i = 0; t->reversed && i < TRAJECTORY_AXES; i++) goal.speed[i] = -goal.speed[i];
      return goal;
    }
    t_s -= piece.duration_s;
  }
  goal_t goal = piece_at(&piece, t->reversed ? 0.0f : piece.duration_s);
  stop(&goal);
  return goal;
}

static void turn(goal_t *goal, float angle_rad) {
  const float c = cosf(angle_rad), s = sinf(angle_rad);
  float *const rows[] = {goal->at, goal->speed, goal->acc};
  for (int i = 0; i < 3; i++) {
    const float x = rows[i][TRAJECTORY_X], y = rows[i][TRAJECTORY_Y];
    rows[i][TRAJECTORY_X] = c * x - s * y;
    rows[i][TRAJECTORY_Y] = s * x + c * y;
  }
  goal->at[TRAJECTORY_YAW] += angle_rad;
}

bool trajectory_at(const trajectory_t *t, float t_s, goal_t *goal) {
  float spent_s = 0.0f;
  if (t->compressed) {
    if (!reel_at(t, fmaxf(t_s, 0.0f), goal, &spent_s)) return false;
  } else {
    const size_t bytes = (size_t)t->n_piece * TRAJECTORY_PIECE_BYTES;
    if (t->n_piece < 1 || bytes > t->size || !(t->timescale > 0.0f)) return false;
    *goal = pieces_at(t, t_s / t->timescale);
    slow_down(goal, t->timescale);
    if (!t->reversed) turn(goal, t->turn_rad);
  }
  for (int i = 0; i < 3; i++) goal->at[i] += t->shift_m[i];
  for (int i = 0; i < TRAJECTORY_AXES; i++)
    if (!isfinite(goal->at[i]) || !isfinite(goal->speed[i]) || !isfinite(goal->acc[i])) return false;
  return true;
}

float trajectory_duration_s(const trajectory_t *t) {
  float sum_s = 0.0f;
  goal_t goal;
  if (t->compressed) return reel_at(t, HUGE_VALF, &goal, &sum_s) ? sum_s : 0.0f;
  for (int i = 0; i < t->n_piece && (size_t)(i + 1) * TRAJECTORY_PIECE_BYTES <= t->size; i++)
    sum_s += piece_of(t, i).duration_s;
  return t->timescale * sum_s;
}
