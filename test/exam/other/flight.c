// flight.c - the second plant's flights: the set points, the loop, and the log's rows.
#include "exam/other/flight.h"

#include <string.h>

#define STEPS   4 // steps of the plant per tick
#define PIECES  7
#define LOST_M  1.5
#define STAND_S 2.5  // before and after a ladder
#define UNDER_M 0.06 // set point below the floor of a vehicle that is to stand
#define LATE    16   // ticks for which commands are kept

// --- the set points ----------------------------------------------------------------------------------------

typedef struct {
  const nature_t *room;
  bool ladder;
  double far, span_s, quick;
  int order[PIECES];
  double number[PIECES][4];
  // the set point, smoothed by three lags in series
  vec_t lag[3];
  double yaw[3];
} plan_t;

static const int SORT[SORTS][PIECES] = {
    [SORT_UPRIGHT] = {3, 4, 6, 3, 5, 4, 3}, [SORT_SIDEWAYS] = {0, 1, 2, 0, 1, 2, 0}};

static void shuffle(plan_t *p, int sort, dice_t *d) {
  for (int i = 0; i < PIECES; i++) {
    p->order[i] = i;
    for (int k = 0; k < 4; k++) p->number[i][k] = dice_share(d);
  }
  for (int i = PIECES - 1; i > 0; i--) {
    const int k = (int)dice_between(d, 0.0, i + 0.999), swap = p->order[i];
    p->order[i] = p->order[k];
    p->order[k] = swap;
  }
  for (int i = 0; i < PIECES && sort != SORT_ALL; i++) p->order[i] = SORT[sort][p->order[i]];
}

static double square(double t_s, double half_s) {
  return fmod(t_s, 2.0 * half_s) < half_s ? 1.0 : -1.0;
}

static vec_t told(const plan_t *p, int piece, double t, double span, double *yaw) {
  const double *const n = p->number[piece], angle = 2.0 * OTHER_PI * n[0],
                      wave = pow(sin(OTHER_PI * t / span), 2.0);
  const double R = p->room->radius_m;
  vec_t at = vec(0.0, 0.0, 0.5 * p->far);
  double far_m = 0.0;
  switch (piece) {
  case 0: far_m = p->far * (0.15 + 0.15 * n[1]) * square(t, 0.6 + 0.3 * n[2]); break;
  case 1: far_m = t < 0.5 * span ? p->far * (0.5 + 0.4 * n[1]) : 0.0; break;
  case 2: {
    const double turn = (n[0] < 0.5 ? 1.0 : -1.0) * (1.3 + 0.8 * n[1]) * t / sqrt(p->far),
                 r = p->far * (0.4 + 0.3 * n[2]);
    return vec(r * sin(turn), r * (1.0 - cos(turn)), at.z);
  }
  case 3: at.z += 0.2 * p->far * square(t, 0.5 + 0.4 * n[1]); break;
  case 4: *yaw += (n[0] < 0.5 ? 2.0 : -2.0) * OTHER_PI * fmin(1.0, 1.2 * t / span); break;
  case 5:
    if (p->room->ceiling_m < 1e3) at.z = p->room->ceiling_m - R * (1.4 + 0.8 * n[1] + 2.5 * wave);
    break;
  default: at.z = R * (1.4 + 0.8 * n[1] + 3.0 * wave);
  }
  return vec(far_m * cos(angle), far_m * sin(angle), at.z);
}

// The set point of a ladder: stands, climbs in steps to the top, steps down, lands.
static vec_t told_ladder(const plan_t *p, double t_s) {
  const nature_t *const room = p->room;
  const bool under = room->ceiling_m < 1e3;
  const double top_m =
      under ? room->ceiling_m - room->radius_m * (1.4 + 1.5 * p->number[0][0]) : 0.9 * p->far;
  const double share = (t_s - STAND_S) / (p->span_s - 2.0 * STAND_S);
  const int steps = 3 + (int)(2.999 * p->number[0][1]), i = (int)floor(share * (2 * steps - 1));
  const int level = i < steps ? i + 1 : 2 * steps - 1 - i;
  if (share < 0.0 || share >= 1.0) return vec(0.0, 0.0, room->rest_m - UNDER_M);
  return vec(0.0, 0.0, room->rest_m + (top_m - room->rest_m) * level / steps);
}

static pilot_wish_t wish_at(plan_t *p, double t_s) {
  const double span = p->span_s / PIECES;
  const int i = (int)fmin(t_s / span, PIECES - 1.0);
  double yaw = 0.0;
  for (int k = 0; k < i; k++)
    if (p->order[k] == 4) yaw += p->number[4][0] < 0.5 ? 2.0 * OTHER_PI : -2.0 * OTHER_PI;
  vec_t in = told(p, p->order[i], t_s - i * span, span, &yaw);
  if (p->ladder) in = told_ladder(p, t_s), yaw = 0.0;
  const vec_t before = p->lag[2];
  const double k = 1.0 - exp(-p->quick * PILOT_S);
  for (int n = 0; n < 3; n++) {
    p->lag[n] = in = vec_more(p->lag[n], k, vec_more(in, -1.0, p->lag[n]));
    p->yaw[n] = yaw = p->yaw[n] + k * (yaw - p->yaw[n]);
  }
  return (pilot_wish_t){p->lag[2], vec_times(1.0 / PILOT_S, vec_more(p->lag[2], -1.0, before)), yaw};
}

static plan_t plan_of(const other_job_t *job, dice_t *d) {
  plan_t p = {
      .room = &job->truth, .ladder = job->ladder, .far = hide_stretch(&job->known), .span_s = job->span_s};
  p.quick = dice_between(d, 3.6, 4.6) / sqrt(p.far);
  shuffle(&p, job->sort, d);
  double yaw = 0.0;
  const vec_t at = p.ladder ? told_ladder(&p, 0.0) : told(&p, p.order[0], 0.0, 1.0, &yaw);
  for (int n = 0; n < 3; n++) p.lag[n] = vec(0.0, 0.0, at.z);
  return p;
}

// --- the log -----------------------------------------------------------------------------------------------

enum { COLUMNS = 27 };
static const char HEAD[] =
    "t,px,py,pz,vx,vy,vz,qw,qx,qy,qz,ax,ay,az,p,q,r,cmd1,cmd2,cmd3,cmd4,volt,up,sx,sy,sz,syaw";

static double as_logged(const other_job_t *job, double radps) {
  if (job->habits.unit == COMMAND_N) return job->known.k_Ns2 * radps * radps;
  return job->habits.unit == COMMAND_SHARE ? radps / job->known.most_radps : radps;
}

static void row_of(const other_job_t *job, const senses_state_t *s, const pilot_wish_t *w,
                   const double command[4], double t_s, double row[COLUMNS]) {
  const pilot_view_t *const v = &s->view;
  const double now[COLUMNS] = {t_s,
                               v->pos_m.x,
                               v->pos_m.y,
                               v->pos_m.z,
                               v->vel_mps.x,
                               v->vel_mps.y,
                               v->vel_mps.z,
                               v->q.w,
                               v->q.x,
                               v->q.y,
                               v->q.z,
                               s->acc_mps2.x,
                               s->acc_mps2.y,
                               s->acc_mps2.z,
                               s->gyro_radps.x,
                               s->gyro_radps.y,
                               s->gyro_radps.z,
                               0.0,
                               0.0,
                               0.0,
                               0.0,
                               s->volt,
                               s->range_up_m,
                               w->pos_m.x,
                               w->pos_m.y,
                               w->pos_m.z,
                               w->yaw_rad};
  memcpy(row, now, sizeof now);
  for (int i = 0; i < 4; i++) row[17 + i] = as_logged(job, command[i]);
}

// Puts the fault into a row of the log; a fault of the columns file is put in by user.c.
static void soil(const other_job_t *job, double row[COLUMNS], double kept[2]) {
  const dirt_t dirt = job->habits.dirt;
  const double t_s = row[0];
  if (dirt == DIRT_HALF) row[18] *= 0.5;
  if (t_s <= 5.0) kept[0] = row[15];
  if (t_s <= PILOT_S * job->habits.every) kept[1] = row[21];
  if (dirt == DIRT_GYRO) row[15] = kept[0];
  if (dirt == DIRT_VOLT) row[21] = kept[1];
  if (dirt == DIRT_HOLES && lround(t_s / PILOT_S / job->habits.every) % 10 == 0) row[13] = (double)NAN;
  if (dirt == DIRT_BACKWARDS && t_s > 8.0) row[0] -= 1.0;
  for (int k = 11; dirt == DIRT_UNIT && k < 14; k++) row[k] /= NATURE_G_MPS2;
}

static void write_row(const double row[COLUMNS], bool ranges, FILE *out) {
  for (int k = 0; k < COLUMNS; k++) {
    if (k) putc(',', out);
    if (k != 22 || ranges)
      fprintf(out, k == 0 ? "%.4f" : "%.7g", row[k]);
    else
      fputs("nan", out);
  }
  putc('\n', out);
}

typedef struct {
  nature_flight_t body;
  pilot_state_t pilot;
  senses_state_t senses;
  plan_t plan;
  dice_t dice;
  double command[LATE][4]; // of the last ticks
  double sum[COLUMNS];     // of a row that is a mean
  double kept[2];          // values of what stands still
  double full_V, fall_Vps;
} other_t;

static void log_tick(other_t *o, const other_job_t *job, const pilot_wish_t *wish, int tick, FILE *out) {
  const habits_t *const h = &job->habits;
  const int late = (int)lround(h->late_s / PILOT_S), from = tick > late ? tick - late : 0;
  double row[COLUMNS];
  row_of(job, &o->senses, wish, o->command[from % LATE], tick * PILOT_S, row);
  if (!h->means) {
    if (tick % h->every) return;
    soil(job, row, o->kept);
    write_row(row, tick % 50 == 0, out);
    return;
  }
  for (int k = 0; k < COLUMNS; k++) o->sum[k] = (tick % h->every ? o->sum[k] : 0.0) + row[k] / h->every;
  if (tick % h->every != h->every - 1) return;
  o->sum[0] = (tick + 1) * PILOT_S;
  o->sum[22] = row[22];
  soil(job, o->sum, o->kept);
  write_row(o->sum, tick / h->every % (50 / h->every) == 0, out);
}

static void battery(other_t *o, const nature_t *known, const double command[4], double t_s) {
  double load = 0.0;
  for (int i = 0; i < 4; i++) load += 0.25 * pow(command[i] / nature_hover_radps(known), 2.0);
  o->body.volt = o->full_V - o->fall_Vps * t_s - 0.12 * (load - 1.0);
}

// True before take-off and after landing: the motors are off.
static bool stands(const other_t *o, const pilot_wish_t *wish) {
  const double rest_m = o->body.nature->rest_m;
  return o->body.s.pos_m.z <= rest_m && wish->pos_m.z < rest_m;
}

static bool lost(const other_t *o, const pilot_wish_t *wish) {
  const vec_t off = vec_more(o->body.s.pos_m, -1.0, wish->pos_m);
  if (o->plan.ladder) return !(vec_length(off) < LOST_M) || o->body.s.pos_m.z >= o->body.nature->ceiling_m;
  return !(vec_length(off) < LOST_M) || o->body.s.pos_m.z <= o->body.nature->rest_m ||
         o->body.s.pos_m.z >= o->body.nature->ceiling_m;
}

// Adds the time for which a surface is felt. On the floor nothing is felt.
static void feel(felt_t *felt, const other_job_t *job, const nature_flight_t *body) {
  const double z = body->s.pos_m.z;
  if (z <= body->nature->rest_m) return;
  const double ceiling = nature_ceiling_gain(&job->truth, z) - nature_ceiling_gain(&job->known, z);
  const double ground = nature_ground_gain(&job->truth, z) - nature_ground_gain(&job->known, z);
  if (fabs(ceiling) >= FELT_GAIN) felt->ceiling_s += PILOT_S;
  if (fabs(ground) >= FELT_GAIN) felt->ground_s += PILOT_S;
}

bool other_fly(const other_job_t *job, FILE *out, felt_t *felt) {
  static _Thread_local other_t o;
  memset(&o, 0, sizeof o);
  o.dice.at = job->seed;
  o.plan = plan_of(job, &o.dice);
  o.full_V = dice_between(&o.dice, 3.75, 4.15);
  o.fall_Vps = dice_between(&o.dice, 0.1, 0.3) / job->span_s;
  nature_start(&o.body, &job->truth, vec(0.0, 0.0, fmax(o.plan.lag[2].z, job->truth.rest_m)));
  if (job->ladder) {
    memset(o.body.s.rotor_radps, 0, sizeof o.body.s.rotor_radps);
    memset(o.body.late_radps, 0, sizeof o.body.late_radps);
  }
  o.body.volt = o.full_V;
  pilot_start(&o.pilot, &job->known, job->briskness);
  senses_start(&o.senses, &job->senses, &o.body);
  fprintf(out, "%s\n", HEAD);
  for (int tick = 0; tick < (int)lround(job->span_s / PILOT_S); tick++) {
    double *const command = o.command[tick % LATE];
    const pilot_wish_t wish = wish_at(&o.plan, tick * PILOT_S);
    senses_see(&o.senses, &o.body, &o.dice);
    if (stands(&o, &wish)) {
      pilot_start(&o.pilot, &job->known, job->briskness);
      memset(command, 0, sizeof o.command[0]);
    } else
      pilot_fly(&o.pilot, &o.senses.view, &wish, command);
    log_tick(&o, job, &wish, tick, out);
    battery(&o, &job->known, command, tick * PILOT_S);
    for (int k = 0; k < STEPS; k++) nature_step(&o.body, command);
    feel(felt, job, &o.body);
    if (lost(&o, &wish)) return false;
  }
  felt->strange_s += o.body.felt_s;
  return !ferror(out);
}
