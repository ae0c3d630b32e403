// grid.h - a part of a flight on a coarser grid, about 50 Hz: means over whole numbers of samples.
#ifndef SIM_GAP_2_PREDICT_GRID_H
#define SIM_GAP_2_PREDICT_GRID_H

#include "body/body.h"
#include "gap/1_read/flight.h"

// Channels of the residual, measured less predicted. F: specific force. W: angular acceleration. Range: of
// the upward sensor where the vehicle file has a ceiling and the log that range, else of the downward one.
enum { CH_FX, CH_FY, CH_FZ, CH_WX, CH_WY, CH_WZ, CH_RANGE, CHANNELS };
#define CH_FORCES 3
#define CH_SMOOTH 6 // channels that are filtered

extern const char *const gap_channel[CHANNELS], *const gap_unit[CHANNELS];

typedef struct {
  double t_s;
  int segment;
  bool ok; // flying, nothing touched, no motor at a limit, every signal there
  d3_t pos_w_m,
      vel_w_mps;             // centre of mass, floor at 0; short-lived errors are smoothed out (smooth.c)
  d3_t seen_w_m, seen_w_mps; // both as they are logged
  dq_t q_wb;
  d3_t rate_b_radps, acc_b_mps2;
  double vbat_V;
  double range_m;          // fresh, else NaN
  double range_before_s;   // how long before t_s it was taken
  double clear_m;          // estimated distance of its nearest part from ceiling or floor; NaN: not known
  bool touches;            // one of them, by that distance or by what pushes it (bumps.c)
  d3_t set_w_m, set_w_mps; // set points of the controller, NaN where the log has none
  double set_yaw_rad;
} grid_point_t;

// Marks of a point. Free: it is ok; turn free: its neighbours are, too. First, last: of a segment.
enum { MARK_FREE = 1, MARK_TURN_FREE = 2, MARK_FIRST = 4, MARK_LAST = 8 };

#define GRID_MOTORS 4 // motor histories kept

// Thrust of the rotors in free air, and its rate of change, at the points, for one lag and delay. A delay
// below 0: commands that are logged late.
typedef struct {
  lag_t lag;
  double delay_s;
  double *thrust_N[ROTORS], *rise_Nps[ROTORS];
  // Corrections for differences over the neighbouring points (holds.h): of the thrust, and of its rate of
  // change over its root; null: none.
  double *later_N[ROTORS], *later_rootNps[ROTORS];
  bool lent; // belongs to another grid: read only
} lagged_t;

typedef struct {
  const gap_flight_t *flight;
  int from, samples, every; // the first sample; number of samples; samples in a point
  double period_s;          // of points
  double command_Hz;        // how often the motors were commanded; 0: not known
  int n;
  grid_point_t *point;
  unsigned char *mark; // MARK_*, by point; null until the grid is in a set
  bool has_attitude, has_rates, has_force, has_velocity, has_position, has_vbat, has_moments, range_up;
  bool velocity_made, acceleration_made; // differentiated, because not logged
  double slowest_N;                      // thrust of a rotor at ROTOR_SLOWEST_RADPS
  bool by_speeds; // the log has no commands: measured rotor speeds stand in for them, without a lag
  int bumps;      // points left out at or near a touched ceiling,
  double bump_s;  // and the time of the first one
  double *command_N[ROTORS];  // by sample, from `from`
  double *measured_N[ROTORS]; // by point, from rotor speeds that are logged beside commands; null: none are
  lagged_t motors[GRID_MOTORS];
  int motors_used;
  struct points *eight; // room to compute eight points side by side, for one thread; null: none yet
} grid_t;

// Makes the grid of samples from..to-1 of a flight. BAD_INPUT: the log has neither commands nor rotor speeds;
// FAILED: no memory.
MUST_CHECK done_t grid_make(grid_t *g, const gap_flight_t *flight, int from, int to, const model_t *m,
                            why_t *why);
void grid_free(grid_t *g);

// True if rows come less often than commands.
bool grid_is_slow(const grid_t *g);
// True if rows miss most commands, too: rows that are instants do, rows that are means hold them all.
bool grid_misses_commands(const grid_t *g);

// Clears `ok` of points at which something solid pushes: near floor or ceiling, lift or turning are beyond
// what air can do, and not as at other times (bumps.c). FAILED: no memory.
MUST_CHECK done_t grid_leave_out_bumps(grid_t *g, const model_t *m, why_t *why);

// Smooths out errors of positions and velocities that last less than about a quarter of a second: an effect
// that is multiplied by errors is estimated too small (5_infer/bend.h). A position becomes the mean of those
// about it, each carried along by the logged velocity (flight path reconstruction: Mulder et al. 1999,
// Non-linear aircraft flight path reconstruction review). Velocities are smoothed over their neighbours, as
// much as their errors and the flight's own accelerations ask for. Nothing is smoothed where positions or
// velocities are not logged, nor velocities without accelerometer or attitude. FAILED: no memory.
MUST_CHECK done_t grid_smooth(grid_t *g, why_t *why);

// Returns the rate of the velocity, world axes, by accelerometer and attitude, which must be there.
static inline d3_t grid_acc_w_mps2(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  return d3_sub(axes_to_world(&a, p->acc_b_mps2), d3(0.0, 0.0, G_MPS2));
}

// Returns the first sample, from number i on, at which a point within one segment begins, if there is one.
static inline int grid_begins(const grid_t *g, int i) {
  const int *const segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  while (segment && i + g->every <= g->samples && segment[i] != segment[i + g->every - 1]) i++;
  return i;
}

// Returns the last sample of the segment of sample number i.
static inline int grid_segment_end(const grid_t *g, int i) {
  const int *const segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  if (!segment) return g->samples - 1;
  while (i + 1 < g->samples && segment[i + 1] == segment[i]) i++;
  return i;
}

// Returns the rotor thrusts with this lag and delay; of a grid by speeds, those measured. They are kept for
// later calls. Null: no memory.
const lagged_t *grid_motors(grid_t *g, const lag_t *lag, double delay_s);
// True if two lags with their delays are the same.
bool grid_same_motors(const lag_t *a, double a_delay_s, const lag_t *b, double b_delay_s);

// Returns the angular acceleration (rad/s2) about an axis (0, 1, 2) by the motor commands of one sample.
double grid_turns(const grid_t *g, const model_t *m, int axis, int sample);

// Returns a copy of the grid for one of several threads. New motor histories belong to the copy. The grid
// must not change in the meantime.
grid_t grid_lend(const grid_t *g);
void grid_give_back(grid_t *lent);

// --- what the controller was told (set_points.c) ---------------------------------------------------------

// Reads position, velocity and yaw set points of the point that begins at sample `from`; NaN: not logged.
void set_point_read(const grid_t *g, const model_t *m, int from, grid_point_t *p);

// Sets stale position set points to NaN, axis by axis over the whole grid: those that stand still while the
// velocity's set point moves, and those from which the vehicle stays away.
void set_points_judge(grid_t *g);

// True if the log has a set point of position or velocity on some axis.
bool set_points_there(const grid_t *g);

// Copies the grid, with measured position, velocity and attitude replaced by what the set points alone give:
// the position, or the integral of the velocity; without set points, the mean position and the first heading.
// There are no range samples, and the voltage is a line in time. The caller frees the copy's points. FAILED:
// no memory.
MUST_CHECK done_t set_points_track(const grid_t *g, grid_t *track, why_t *why);

#endif
