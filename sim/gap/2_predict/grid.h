// grid.h - a part of a flight on a coarser grid, about 50 Hz: means over whole numbers of samples.
#ifndef SIM_GAP_2_PREDICT_GRID_H
#define SIM_GAP_2_PREDICT_GRID_H

#include "body/body.h"
#include "gap/1_read/flight.h"

// Residuals. Force: specific force, measured less predicted. Rate: angular acceleration. Range: of the upward
// sensor where the vehicle file has a ceiling, else of the downward one.
enum { CH_FX, CH_FY, CH_FZ, CH_WX, CH_WY, CH_WZ, CH_RANGE, CHANNELS };
#define CH_FORCES 3
#define CH_SMOOTH 6 // channels that are filtered

extern const char *const gap_channel[CHANNELS], *const gap_unit[CHANNELS];

typedef struct {
  double t_s;
  int segment;
  bool ok; // flying, nothing touched, no motor at a limit, every signal there
  d3_t pos_w_m,
      vel_w_mps;             // centre of mass, the floor is at 0; both without errors of a moment (smooth.c)
  d3_t seen_w_m, seen_w_mps; // both as they are logged
  dq_t q_wb;
  d3_t rate_b_radps, acc_b_mps2;
  double vbat_V;
  double range_m;        // fresh, else NaN
  double range_before_s; // so long before t_s it was taken
  double clear_m; // least distance of any part of it from ceiling or floor, as estimated; NaN: not known
  bool touches;   // one of them, as estimated, or by what pushes it (bumps.c)
  d3_t set_w_m, set_w_mps; // what the controller was told, NaN where the log has it not
  double set_yaw_rad;
} grid_point_t;

// Of a point. Free: it can be compared, by its own value or (turning) by its neighbours' too.
enum { MARK_FREE = 1, MARK_TURN_FREE = 2, MARK_FIRST = 4, MARK_LAST = 8 }; // first, last: of a segment

#define GRID_MOTORS 4 // motor histories kept

// Thrust of the rotors in free air for one lag and delay, at the points. A delay below 0: commands that are
// logged late.
typedef struct {
  lag_t lag;
  double delay_s;
  double *thrust_N[ROTORS], *rise_Nps[ROTORS];
  // What differences over the neighbouring points see besides, of thrust, and of how fast it rises over its
  // root (holds.h); null: nothing.
  double *later_N[ROTORS], *later_rootNps[ROTORS];
  bool lent; // another grid's, only to be read
} lagged_t;

typedef struct {
  const gap_flight_t *flight;
  int from, samples, every; // the first sample, how many, how many a point
  double period_s;          // of points
  double command_Hz;        // how often the motors were commanded; 0: nobody said
  int n;
  grid_point_t *point;
  unsigned char *mark; // MARK_*, by point; null until the grid is in a set
  bool has_attitude, has_rates, has_force, has_velocity, has_position, has_vbat, has_moments, range_up;
  bool velocity_made, acceleration_made; // of the place, of the velocity: they are not logged
  double slowest_N;                      // what a rotor gives that is taken to turn at ROTOR_SLOWEST_RADPS
  bool by_speeds; // the log has no commands, and rotor speeds that were measured stand for them: no lag
  int bumps;      // points left out at the ceiling that it touches, or beside it,
  double bump_s;  // and the time of the first one
  double *command_N[ROTORS];  // by sample, from `from`
  double *measured_N[ROTORS]; // by point, of measured rotor speeds beside commands; null: not logged
  lagged_t motors[GRID_MOTORS];
  int motors_used;
  struct points *eight; // room to look at eight points side by side, of one thread; null: none yet
} grid_t;

// The samples from..to-1 of a flight. BAD_INPUT: what the log lacks makes it useless; FAILED: no
// memory.
MUST_CHECK done_t grid_make(grid_t *g, const gap_flight_t *flight, int from, int to, const model_t *m,
                            why_t *why);
void grid_free(grid_t *g);

// Rows come more seldom than commands; those that are of one instant miss most of these, means hold them all.
bool grid_is_slow(const grid_t *g);
bool grid_misses_commands(const grid_t *g);

// Points at which something solid pushes are no good ones: near floor or ceiling it is lifted or turned as no
// air does it, and not as at other times (bumps.c). FAILED: no memory.
MUST_CHECK done_t grid_leave_out_bumps(grid_t *g, const model_t *m, why_t *why);

// Places without what of their errors lasts less than about a quarter of a second: each is carried along by
// the logged velocity, and the mean taken over the points about it (flight path reconstruction: Mulder et al.
// 1999, Non-linear aircraft flight path reconstruction review). What is multiplied by errors is estimated too
// small (5_infer/bend.h). Velocities likewise, by what those about them say, as much as their errors and the
// flight's own accelerations ask for. Both are left as they are where places or velocities are not logged,
// velocities also without an accelerometer or an attitude. FAILED: no memory.
MUST_CHECK done_t grid_smooth(grid_t *g, why_t *why);

// How the velocity changes, in the world, by accelerometer and attitude, which are there.
static inline d3_t grid_acc_w_mps2(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  return d3_sub(axes_to_world(&a, p->acc_b_mps2), d3(0.0, 0.0, G_MPS2));
}

// The first sample from number i on with which a whole point of one segment begins, if there is one.
static inline int grid_begins(const grid_t *g, int i) {
  const int *const segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  while (segment && i + g->every <= g->samples && segment[i] != segment[i + g->every - 1]) i++;
  return i;
}

// The last sample of the segment that has number i.
static inline int grid_segment_end(const grid_t *g, int i) {
  const int *const segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  if (!segment) return g->samples - 1;
  while (i + 1 < g->samples && segment[i + 1] == segment[i]) i++;
  return i;
}

// Rotor thrusts as the vehicle would have them with this lag and delay; of a grid by speeds, as they were.
// Kept for the next call. Null: no memory.
const lagged_t *grid_motors(grid_t *g, const lag_t *lag, double delay_s);
// Whether two such are the same.
bool grid_same_motors(const lag_t *a, double a_delay_s, const lag_t *b, double b_delay_s);

// rad/s2, what a motor command of one sample turns with about an axis (0, 1, 2).
double grid_turns(const grid_t *g, const model_t *m, int axis, int sample);

// The same grid for one thread beside others: motor histories that are new are the copy's own. Meanwhile the
// grid must not change.
grid_t grid_lend(const grid_t *g);
void grid_give_back(grid_t *lent);

// --- what the controller was told (set_points.c) ---------------------------------------------------------

// Place, speed and heading of the samples from `from` on; NaN where the log has them not.
void set_point_read(const grid_t *g, const model_t *m, int from, grid_point_t *p);

// Axis by axis over the whole grid: a place that stands still while the speed moves, or from which the
// vehicle stays away, is left over from before, and is not what it follows: NaN.
void set_points_judge(grid_t *g);

// The log says where the vehicle should have been or gone, on some axis.
bool set_points_there(const grid_t *g);

// The points with measured place, speed and attitude replaced by what follows from the set points alone: the
// place, or the way that the speed leads; where nothing is said, the mean place and the first heading.
// Without range samples; the voltage is a line in time. The caller frees points of the copy. FAILED: no
// memory.
MUST_CHECK done_t set_points_track(const grid_t *g, grid_t *track, why_t *why);

#endif
