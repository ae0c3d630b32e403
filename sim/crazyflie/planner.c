// planner.c - the firmware's high-level commander.
#include "planner.h"

#include <math.h>
#include <string.h>

#define RAD_PER_DEG_F 0.017453293f
#define PI_F          3.14159265f
#define GRAVITY_F     9.81f

enum { NOT_NOW = 1, NOT_KNOWN = 8, BLOCKED = 16 };
enum {
  SET_GROUPS,
  OLD_TAKE_OFF,
  OLD_LAND,
  STOP,
  OLD_GO_TO,
  OLD_START,
  DEFINE,
  TAKE_OFF,
  LAND,
  TAKE_OFF_AT_SPEED,
  LAND_AT_SPEED,
  SPIRAL,
  GO_TO,
  START,
  COMMANDS
};
enum { IN_MEMORY = 1, TYPE_PIECES = 0, TYPE_COMPRESSED = 1 };

const planner_param_t planner_default = {.takeoff_mps = 0.5f, .landing_mps = 0.5f};

void planner_init(planner_t *p) {
  memset(p, 0, sizeof *p);
  p->param = planner_default;
}

static float in_turn(float angle_rad) {
  return remainderf(angle_rad, 2.0f * PI_F);
}

// --- plans ------------------------------------------------------------------------------------------------

static float since_s(const planner_t *p, uint32_t now_ms) {
  return 0.001f * (float)(now_ms - p->begin_ms);
}

static goal_t stand(const goal_t *at) {
  goal_t goal = *at;
  memset(goal.speed, 0, sizeof goal.speed);
  memset(goal.acc, 0, sizeof goal.acc);
  return goal;
}

static int fly_own(planner_t *p, planner_state_t state, piece_t piece, uint32_t now_ms) {
  p->own = piece;
  p->on_own = true;
  p->path = (trajectory_t){.size = sizeof p->own, .n_piece = 1, .timescale = 1.0f};
  p->begin_ms = now_ms;
  p->state = state;
  return 0;
}

// Sets the pointer to `own` anew, since the vehicle may have been moved in memory.
static const trajectory_t *path_of(planner_t *p) {
  if (p->on_own) p->path.memory = (const uint8_t *)&p->own;
  return &p->path;
}

static bool goal_now(planner_t *p, uint32_t now_ms, goal_t *goal) {
  if (planner_finished(p, now_ms) && p->state == PLANNER_LANDING) p->state = PLANNER_IDLE;
  return trajectory_at(path_of(p), since_s(p, now_ms), goal);
}

static int rise(planner_t *p, planner_state_t state, float z_m, float yaw_rad, float duration_s,
                uint32_t now_ms) {
  if (state == PLANNER_FLYING ? p->state != PLANNER_IDLE : p->state == PLANNER_LANDING) return NOT_NOW;
  goal_t from = stand(&p->last);
  from.at[TRAJECTORY_YAW] = in_turn(from.at[TRAJECTORY_YAW]);
  goal_t to = from;
  to.at[TRAJECTORY_Z] = z_m;
  to.at[TRAJECTORY_YAW] += in_turn(yaw_rad - from.at[TRAJECTORY_YAW]);
  return fly_own(p, state, piece_between(&from, &to, duration_s), now_ms);
}

static int go_to(planner_t *p, const float to[4], bool relative, bool linear, float duration_s,
                 uint32_t now_ms) {
  goal_t from = p->last;
  if (planner_active(p) && !goal_now(p, now_ms, &from)) return NOT_NOW;
  goal_t goal = stand(&from);
  for (int i = 0; i < TRAJECTORY_AXES; i++) goal.at[i] = to[i] + (relative ? from.at[i] : 0.0f);
  from.at[TRAJECTORY_YAW] = in_turn(from.at[TRAJECTORY_YAW]);
  goal.at[TRAJECTORY_YAW] =
      from.at[TRAJECTORY_YAW] + in_turn(goal.at[TRAJECTORY_YAW] - from.at[TRAJECTORY_YAW]);
  if (linear) {
    from = stand(&from);
    for (int i = 0; i < TRAJECTORY_AXES; i++)
      goal.speed[i] = from.speed[i] = (goal.at[i] - from.at[i]) / duration_s;
  }
  return fly_own(p, PLANNER_FLYING, piece_between(&from, &goal, duration_s), now_ms);
}

typedef struct {
  bool sideways, clockwise;
  float angle_rad, r0_m, rf_m, climb_m, duration_s;
} spiral_t;

// Position, velocity and acceleration relative to the centre, at heading f on a circle whose radius changes
// at a constant rate. In forward flight the centre is at the side, in sideways flight ahead.
static void on_spiral(const spiral_t *s, float f, float r_m, float spin_radps, float dr_mps, goal_t *g) {
  const float side = s->clockwise ? 1.0f : -1.0f;
  const float a = f + (s->sideways ? PI_F : PI_F / 2.0f); // from the centre to the vehicle, if clockwise
  const float c = side * cosf(a), q = side * sinf(a);
  g->at[0] = r_m * c, g->at[1] = r_m * q;
  g->speed[0] = dr_mps * c - r_m * spin_radps * q;
  g->speed[1] = dr_mps * q + r_m * spin_radps * c;
  g->acc[0] = -2.0f * dr_mps * spin_radps * q - r_m * spin_radps * spin_radps * c;
  g->acc[1] = 2.0f * dr_mps * spin_radps * c - r_m * spin_radps * spin_radps * q;
}

static int spiral(planner_t *p, spiral_t s, uint32_t now_ms) {
  s.angle_rad = fminf(fmaxf(s.angle_rad, -2.0f * PI_F), 2.0f * PI_F);
  s.r0_m = fmaxf(s.r0_m, 0.0f), s.rf_m = fmaxf(s.rf_m, 0.0f);
  const float way_rad = s.clockwise ? -s.angle_rad : s.angle_rad, T = s.duration_s;
  goal_t from = stand(&p->last), to = from, begin = from, end = from;
  const float yaw_rad = in_turn(from.at[TRAJECTORY_YAW]);
  on_spiral(&s, yaw_rad, s.r0_m, way_rad / T, (s.rf_m - s.r0_m) / T, &begin);
  on_spiral(&s, yaw_rad + way_rad, s.rf_m, way_rad / T, (s.rf_m - s.r0_m) / T, &end);
  for (int i = 0; i < 2; i++) {
    to.at[i] = from.at[i] - begin.at[i] + end.at[i];
    from.speed[i] = begin.speed[i], to.speed[i] = end.speed[i];
    from.acc[i] = begin.acc[i], to.acc[i] = end.acc[i];
  }
  from.at[TRAJECTORY_YAW] = yaw_rad, to.at[TRAJECTORY_YAW] = yaw_rad + way_rad;
  to.at[TRAJECTORY_Z] += s.climb_m;
  from.speed[TRAJECTORY_Z] = to.speed[TRAJECTORY_Z] = s.climb_m / T;
  from.speed[TRAJECTORY_YAW] = to.speed[TRAJECTORY_YAW] = way_rad / T;
  return fly_own(p, PLANNER_FLYING, piece_between(&from, &to, T), now_ms);
}

typedef struct {
  bool relative, relative_yaw, reversed;
  uint8_t id;
  float timescale;
} start_t;

static int start(planner_t *p, const start_t *s, uint32_t now_ms) {
  if (s->id >= PLANNER_TRAJECTORIES) return 0; // no error, as in the firmware
  const planner_entry_t *const e = &p->entry[s->id];
  if (!e->is_there || e->offset > PLANNER_MEMORY) return 0;
  const bool compressed = e->type == TYPE_COMPRESSED;
  if (compressed && (s->timescale != 1.0f || s->reversed)) return NOT_KNOWN;
  trajectory_t path = {.memory = p->memory + e->offset,
                       .size = PLANNER_MEMORY - e->offset,
                       .n_piece = e->n_piece,
                       .compressed = compressed,
                       .timescale = s->timescale,
                       .reversed = s->reversed};
  goal_t first;
  if (!trajectory_at(&path, 0.0f, &first)) return NOT_KNOWN;
  if (s->relative)
    for (int i = 0; i < 3; i++) path.shift_m[i] = p->last.at[i] - first.at[i];
  if (s->relative && s->relative_yaw && !compressed)
    path.turn_rad = in_turn(p->last.at[TRAJECTORY_YAW] - first.at[TRAJECTORY_YAW]);
  p->path = path;
  p->on_own = false;
  p->begin_ms = now_ms;
  p->state = PLANNER_FLYING;
  return 0;
}

// --- commands ---------------------------------------------------------------------------------------------

// Reads little-endian, packed numbers, as the client sends them.
typedef struct {
  const uint8_t *at;
} reader_t;

static uint8_t byte(reader_t *r) {
  return *r->at++;
}
static float number(reader_t *r) {
  float value;
  memcpy(&value, r->at, sizeof value);
  r->at += sizeof value;
  return value;
}

static int define(planner_t *p, reader_t r) {
  const uint8_t id = byte(&r), place = byte(&r), type = byte(&r);
  if (id >= PLANNER_TRAJECTORIES) return NOT_KNOWN;
  uint32_t offset;
  memcpy(&offset, r.at, sizeof offset);
  p->entry[id] = (planner_entry_t){place == IN_MEMORY && type <= TYPE_COMPRESSED, type, offset, r.at[4]};
  return 0;
}

static int take_rise(planner_t *p, int command, reader_t r, uint32_t now_ms) {
  const bool up = command == TAKE_OFF || command == TAKE_OFF_AT_SPEED || command == OLD_TAKE_OFF;
  const bool by_speed = command == TAKE_OFF_AT_SPEED || command == LAND_AT_SPEED;
  const bool old = command == OLD_TAKE_OFF || command == OLD_LAND;
  float height_m = number(&r), yaw_rad = 0.0f;
  const bool relative = by_speed && byte(&r);
  if (!old) yaw_rad = number(&r);
  if (!old && byte(&r)) yaw_rad = p->last.at[TRAJECTORY_YAW];
  float duration_s = number(&r);
  const float z_m = p->last.at[TRAJECTORY_Z];
  if (relative) height_m = up ? z_m + height_m : z_m - height_m;
  if (by_speed) {
    const float usual_mps = up ? p->param.takeoff_mps : p->param.landing_mps;
    duration_s = fabsf(height_m - z_m) / (duration_s > 0.0f ? duration_s : usual_mps);
  }
  return rise(p, up ? PLANNER_FLYING : PLANNER_LANDING, height_m, yaw_rad, duration_s, now_ms);
}

static int take_go_to(planner_t *p, bool old, reader_t r, uint32_t now_ms) {
  const bool relative = byte(&r), linear = !old && byte(&r);
  float to[TRAJECTORY_AXES];
  for (int i = 0; i < TRAJECTORY_AXES; i++) to[i] = number(&r);
  return go_to(p, to, relative, linear, number(&r), now_ms);
}

static int take_spiral(planner_t *p, reader_t r, uint32_t now_ms) {
  spiral_t s = {.sideways = byte(&r)};
  s.clockwise = byte(&r);
  s.angle_rad = number(&r);
  s.r0_m = number(&r);
  s.rf_m = number(&r);
  s.climb_m = number(&r);
  s.duration_s = number(&r);
  return spiral(p, s, now_ms);
}

static int take_start(planner_t *p, bool old, reader_t r, uint32_t now_ms) {
  start_t s = {.relative = byte(&r)};
  s.relative_yaw = !old && byte(&r);
  s.reversed = byte(&r);
  s.id = byte(&r);
  s.timescale = number(&r);
  return start(p, &s, now_ms);
}

// Bytes after each command's number.
static const int size_of[COMMANDS] = {
    [SET_GROUPS] = 1,     [OLD_TAKE_OFF] = 9, [OLD_LAND] = 9,  [STOP] = 1,  [OLD_GO_TO] = 22,
    [OLD_START] = 8,      [DEFINE] = 8,       [TAKE_OFF] = 14, [LAND] = 14, [TAKE_OFF_AT_SPEED] = 15,
    [LAND_AT_SPEED] = 15, [SPIRAL] = 23,      [GO_TO] = 23,    [START] = 9,
};

static int fly(planner_t *p, int command, reader_t r, uint32_t now_ms) {
  switch (command) {
  case OLD_GO_TO:
  case GO_TO: return take_go_to(p, command == OLD_GO_TO, r, now_ms);
  case SPIRAL: return take_spiral(p, r, now_ms);
  case OLD_START:
  case START: return take_start(p, command == OLD_START, r, now_ms);
  default: return take_rise(p, command, r, now_ms);
  }
}

int planner_command(planner_t *p, const uint8_t *bytes, int size, uint32_t now_ms) {
  const int command = size > 0 ? bytes[0] : COMMANDS;
  if (command >= COMMANDS || size - 1 < size_of[command]) return NOT_KNOWN;
  reader_t r = {bytes + 1};
  if (command == DEFINE) return define(p, r);
  const uint8_t group = byte(&r);
  if (command == SET_GROUPS) {
    p->param.groups = group;
    return 0;
  }
  if (command != STOP && p->blocked) return BLOCKED;
  if (group != 0 && !(group & p->param.groups)) return 0;
  if (command != STOP) return fly(p, command, r, now_ms);
  planner_stop(p);
  return 0;
}

int planner_land(planner_t *p, float height_m, float speed_mps, bool relative, uint32_t now_ms) {
  uint8_t command[16] = {LAND_AT_SPEED, 0};
  memcpy(command + 2, &height_m, 4);
  command[6] = relative;
  command[11] = true; // keep the present heading
  memcpy(command + 12, &speed_mps, 4);
  return planner_command(p, command, sizeof command, now_ms);
}

void planner_stop(planner_t *p) {
  p->state = PLANNER_IDLE;
}
void planner_disable(planner_t *p) {
  p->state = PLANNER_DISABLED;
}

void planner_block(planner_t *p, bool block) {
  if (block && !p->blocked && planner_active(p)) planner_stop(p);
  p->blocked = block;
}

// --- set points -------------------------------------------------------------------------------------------

void planner_tell(planner_t *p, const state_t *state) {
  p->last = (goal_t){
      .at = {state->position.x, state->position.y, state->position.z, RAD_PER_DEG_F * state->attitude.yaw},
      .speed = {state->velocity.x, state->velocity.y, state->velocity.z}};
}

bool planner_active(const planner_t *p) {
  return p->state == PLANNER_FLYING || p->state == PLANNER_LANDING;
}

bool planner_finished(const planner_t *p, uint32_t now_ms) {
  trajectory_t path = p->path;
  if (p->on_own) path.memory = (const uint8_t *)&p->own;
  return !path.memory || since_s(p, now_ms) >= trajectory_duration_s(&path);
}

static setpoint_t setpoint_at(const goal_t *g) {
  const float up = (g->acc[2] + GRAVITY_F) /
                   sqrtf(g->acc[0] * g->acc[0] + g->acc[1] * g->acc[1] +
                         (g->acc[2] + GRAVITY_F) * (g->acc[2] + GRAVITY_F)); // z of the thrust's direction
  return (setpoint_t){
      .mode = {.x = modeAbs, .y = modeAbs, .z = modeAbs, .yaw = modeAbs},
      .position = {0, g->at[0], g->at[1], g->at[2]},
      .velocity = {0, g->speed[0], g->speed[1], g->speed[2]},
      .acceleration = {0, g->acc[0], g->acc[1], g->acc[2]},
      .attitude.yaw = g->at[TRAJECTORY_YAW] / RAD_PER_DEG_F,
      .attitudeRate.yaw = up * g->speed[TRAJECTORY_YAW] / RAD_PER_DEG_F,
  };
}

bool planner_setpoint(planner_t *p, const state_t *state, uint32_t now_ms, setpoint_t *set) {
  goal_t goal;
  if (planner_active(p)) {
    if (goal_now(p, now_ms, &goal)) {
      p->last = goal;
      *set = setpoint_at(&goal);
      return true;
    }
    planner_disable(p);
    return false;
  }
  planner_tell(p, state);
  if (p->state == PLANNER_DISABLED) return false;
  *set = (setpoint_t){.thrust = 0.0f};
  return true;
}
