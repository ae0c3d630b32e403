// family.c - the rivals of each name.
#include "gap/5_infer/family.h"

#include "gap/5_infer/evidence.h"
#include "gap/5_infer/local.h"
#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>

// --- what is left unexplained -----------------------------------------------------------------------------

// By channel, the largest cell that no name explains, in standard errors beyond nominal flights; 0: chance.
typedef struct {
  double errors[CHANNELS];
} unexplained_t;

static double beyond_nominal(const round_t *r, double statistic) {
  double chance = 0.0;
  for (int i = 0; r->nominal && i < r->nominal->n; i++)
    chance = fmax(chance, unknown_in_windows(&r->nominal->scan[i]));
  return sqrt(fmax(statistic * statistic - chance * chance, 0.0));
}

static done_t measure_cells(const round_t *r, double *const left[CHANNELS], unexplained_t *u, why_t *why) {
  color_t color[CHANNELS];
  cell_t cell[CHANNELS];
  for (int ch = 0; r->s->n_grid > 1 && ch < CHANNELS; ch++) // whitening takes a flight's constant, too
    rows_center(set_rows(r->s, ch), left[ch]);
  TRY(unknown_colors(r->s, r->base, left, color, why));
  TRY(unknown_along(r->s, r->base, 0, COORDINATES, left, color, true, cell, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    if (color[ch].used) u->errors[ch] = beyond_nominal(r, cell[ch].statistic);
  return DONE;
}

static done_t find_unexplained(const round_t *r, unexplained_t *u, why_t *why) {
  double *left[CHANNELS] = {NULL};
  *u = (unexplained_t){{0.0}};
  done_t status = local_left(r, &r->choice, left, why);
  if (status == DONE) status = measure_cells(r, left, u, why);
  for (int ch = 0; ch < CHANNELS; ch++) free(left[ch]);
  return status;
}

// Returns the unexplained standard errors of all channels in which either candidate shows.
static double unexplained_of(const round_t *r, const unexplained_t *u, int own, int other) {
  double sum = 0.0;
  for (int ch = 0; ch < CHANNELS; ch++) {
    bool shows = false;
    for (int i = 0; i < 2; i++) {
      const candidate_t *const c = &r->c->candidate[i ? other : own];
      for (int k = 0; k < c->n; k++) shows = shows || r->table.x[ch][c->first + k];
    }
    if (shows && r->gram.color[ch].used) sum += u->errors[ch] * u->errors[ch];
  }
  return sqrt(sum);
}

// --- rivals -----------------------------------------------------------------------------------------------

typedef struct {
  const fx_t *fx;
  double share, left; // of the gap that it would explain; white sum of squares left then
  int candidate;      // in its best form
} rival_t;

// True if only the turning could tell the two apart, as mass and thrust scale, and it does not.
static bool only_turning_tells(const round_t *r, int a, int b) {
  return round_fx(r, a)->group == FX_WEIGHT && round_fx(r, b)->group == FX_WEIGHT && !r->turning_told;
}

// A torque scale acts about z as an inertia does; a log that misses commands does not show what the inertia
// does about x and y.
static bool missed_commands_hide(const round_t *r, int own, int other) {
  return round_fx(r, own)->scales == FX_SCALES_TORQUE && round_fx(r, other)->scales == FX_SCALES_INERTIA &&
         candidates_slow(r->s);
}

// True if the candidate cannot be a rival. Selection excludes the delay once it has settled on a lag, and the
// other way round, but the two still look alike unless rotor speeds were measured.
static bool is_out(const round_t *r, bool measured, int i) {
  return r->never[i] && (measured || round_fx(r, i)->group != FX_TIMING);
}

// True if the candidate leaves less in the name's place, and beside it the name gives less than half of what
// it gave. Selection may have refused it for what feedback makes of it, yet it may be there: for example a
// lag where a delay was named.
static bool fits_better(const round_t *r, int own, const choice_t *with) {
  const choice_t rest = choice_without(&r->choice, own), both = choice_with(with, own);
  const double named = score_left(&r->score, &r->choice, NULL), other = score_left(&r->score, with, NULL);
  const double gives = score_left(&r->score, &rest, NULL) - named;
  return other < named && other - score_left(&r->score, &both, NULL) < (1.0 - SCORE_MOST) * gives;
}

// with: the choice with the other candidate in the name's place, as its last. True if it fits better, or
// gives, alone or beside the other names, most of what the name gives. A difference below what a right form
// leaves counts as none: linearisation is no more exact.
static bool could_stand(const round_t *r, const unexplained_t *u, int own, const choice_t *with) {
  const int other = with->of[with->n - 1];
  if (only_turning_tells(r, own, other) || missed_commands_hide(r, own, other)) return true;
  if (!score_is_possible(&r->score, with)) return false;
  if (fits_better(r, own, with)) return true;
  const choice_t nothing = {.n = 0}, alone = choice_with(&nothing, other);
  const double like = score_likeness(&r->score, &r->choice, own, with);
  const double most = fmax(like, score_likeness(&r->score, &r->choice, own, &alone));
  if (!(most > SCORE_MOST)) return false;
  return 1.0 - like < CANDIDATES_MISFIT * CANDIDATES_MISFIT ||
         score_is_rival(&r->score, &r->choice, with, unexplained_of(r, u, own, other));
}

// Keeps one rival per effect, in the shape that leaves least; sorted by what is left.
static void keep(rival_t *list, int *n, const rival_t *one) {
  int at = 0;
  while (at < *n && list[at].fx != one->fx) at++;
  if (at < *n && list[at].left <= one->left) return;
  if (at == *n) ++*n;
  for (; at > 0 && list[at - 1].left > one->left; at--) list[at] = list[at - 1];
  list[at] = *one;
}

// Returns the index of a candidate's first number among those of a choice; -1: it is not in it.
static int place_in(const round_t *r, const choice_t *choice, int candidate) {
  for (int i = 0, first = 0; i < choice->n; first += r->c->candidate[choice->of[i++]].n)
    if (choice->of[i] == candidate) return first;
  return -1;
}

// Raises by_rivals of the other names to half of the way that their numbers move with a rival in a name's
// place; the largest way of all names and rivals counts. The others keep their shapes and kinds: numbers of
// different shapes cannot be compared.
static void move_others(const round_t *r, found_t *found, const named_t *named, int rival) {
  const choice_t rest = choice_without(&r->choice, named->candidate), with = choice_with(&rest, rival);
  double here[COLUMN_MAX], there[COLUMN_MAX];
  score_estimate(&r->score, &r->choice, here, NULL);
  score_estimate(&r->score, &with, there, NULL);
  for (int i = 0; i < found->n; i++) {
    named_t *const other = &found->named[i];
    const candidate_t *const c = &r->c->candidate[other->candidate];
    const int a = place_in(r, &r->choice, other->candidate), b = place_in(r, &rest, other->candidate);
    for (int k = 0; a >= 0 && b >= 0 && k < c->n; k++) {
      const double way = candidate_possible(c, k, there[b + k]) - candidate_possible(c, k, here[a + k]);
      other->by_rivals[k] = fmax(other->by_rivals[k], 0.5 * fabs(way));
    }
  }
}

static void take(const rival_t *rival, named_t *named) {
  named->rival[named->n_rival] = rival->fx;
  named->rival_candidate[named->n_rival] = rival->candidate;
  named->rival_share[named->n_rival++] = rival->share;
}

// True if only the turning could tell the candidate from a rival in the list, and it does not: a rival of one
// of the two is a rival of both.
static bool is_twin(const round_t *r, const rival_t *list, int n, int candidate) {
  for (int i = 0; i < n; i++)
    if (only_turning_tells(r, list[i].candidate, candidate)) return true;
  return false;
}

static void find_rivals(const round_t *r, const unexplained_t *u, bool measured, found_t *found,
                        named_t *named) {
  rival_t list[FX_MAX];
  int n = 0;
  const choice_t rest = choice_without(&r->choice, named->candidate);
  const double without = score_left(&r->score, &rest, NULL);
  for (int twins = 0; twins < 2; twins++)
    for (int i = 0; i < r->c->n; i++) {
      if (round_fx(r, i) == round_fx(r, named->candidate) || is_out(r, measured, i)) continue;
      if (!round_fits(r, &rest, i) || (twins && !is_twin(r, list, n, i))) continue;
      const choice_t in_place = choice_with(&rest, i), with = round_reshaped(r, &in_place);
      const bool stands =
          twins ? score_is_possible(&r->score, &with) : could_stand(r, u, named->candidate, &with);
      if (!stands) continue;
      const double left = score_left(&r->score, &with, NULL);
      keep(list, &n,
           &(rival_t){round_fx(r, i), (without - left) / found->left_before, left, with.of[with.n - 1]});
    }
  named->n_rival = 0;
  for (int i = 0; i < n; i++) {
    take(&list[i], named);
    move_others(r, found, named, list[i].candidate);
  }
}

// Returns the candidate as a rival in a name's place, in the form that leaves least; fx null: it explains
// nothing.
static rival_t in_its_place(const round_t *r, double left_before, const named_t *named, int candidate) {
  const candidate_t *const all = r->c->candidate;
  const choice_t rest = choice_without(&r->choice, named->candidate);
  const double without = score_left(&r->score, &rest, NULL);
  rival_t best = {.left = without};
  for (int i = 0; i < r->c->n; i++) {
    if (!candidates_exclude(&all[i], &all[candidate]) || r->never[i] || !round_fits(r, &rest, i)) continue;
    const choice_t with = choice_with(&rest, i);
    const double left = score_left(&r->score, &with, NULL);
    if (left < best.left) best = (rival_t){all[i].use.fx, (without - left) / left_before, left, i};
  }
  return best;
}

// --- probability ------------------------------------------------------------------------------------------

// Returns the effect of a set that explains most in a name's place; fx null: none that is not named does.
static rival_t best_of(const round_t *r, double left_before, const named_t *named,
                       const evidence_set_t *set) {
  const candidate_t *const all = r->c->candidate;
  rival_t best = {.fx = NULL};
  for (int k = 0; set && k < set->n; k++) {
    bool chosen = false;
    for (int i = 0; i < r->choice.n; i++)
      chosen = chosen || candidates_exclude(&all[r->choice.of[i]], &all[set->of[k]]);
    if (chosen) continue;
    const rival_t one = in_its_place(r, left_before, named, set->of[k]);
    if (one.fx && (!best.fx || one.left < best.left)) best = one;
  }
  return best;
}

// Sets a name's probability. While the name and its rivals are less likely than not, the best effect of the
// likeliest set without them becomes a rival: two effects may do together what the name does alone.
static void weigh(const round_t *r, const evidence_t *e, double left_before, named_t *named) {
  int of[FX_MAX + 1] = {named->candidate};
  for (int k = 0; k < named->n_rival; k++) of[k + 1] = named->rival_candidate[k];
  for (;;) {
    const int n = named->n_rival + 1;
    named->probability = evidence_of(e, r->c, n, of);
    if (named->probability >= 0.5 || n > FX_MAX) return;
    const rival_t rival = best_of(r, left_before, named, evidence_without(e, r->c, n, of));
    if (!rival.fx) return;
    take(&rival, named);
    of[n] = rival.candidate;
  }
}

// Weighs all names but one that measured rotor speeds gave: the rows do not judge that.
static done_t weigh_names(const round_t *r, found_t *found, why_t *why) {
  evidence_t e = {.n = 0};
  const done_t status = evidence_make(&e, r, why);
  for (int i = 0; status == DONE && i < found->n; i++) {
    named_t *const named = &found->named[i];
    named->probability = (double)NAN;
    if (e.n && choice_has(&r->choice, named->candidate)) weigh(r, &e, found->left_before, named);
  }
  evidence_free(&e);
  return status;
}

// --- what could not be told apart -------------------------------------------------------------------------

// True if column `other` could give most of what number k does at its typical size, white, and what it could
// not give would go unnoticed.
static bool looks_like(const round_t *r, const candidate_t *c, int k, int other) {
  const int column = c->first + k, n = r->gram.size;
  const double *const G = r->gram.total;
  const double aa = G[column * (n + 1)], bb = G[other * (n + 1)], ab = G[column * n + other];
  const double size = c->typical[k] * c->typical[k] * aa;
  const double given = aa > 0.0 && bb > 0.0 ? ab * ab / (aa * bb) : 0.0; // correlation, squared
  return size > SCORE_RIVAL_LEFT && given > SCORE_MOST && size * (1.0 - given) < SCORE_RIVAL_LEFT;
}

static void join(int *alike, int n, int a, int b) {
  const int first = alike[a] < alike[b] ? alike[a] : alike[b], last = alike[a] + alike[b] - first;
  for (int i = 0; i < n; i++)
    if (alike[i] == last) alike[i] = first;
}

static void find_alike(const round_t *r, found_t *found) {
  for (int i = 0; i < r->c->columns; i++) found->alike[i] = i;
  for (int i = 0; i < r->c->n; i++)
    for (int k = 0; k < r->c->n; k++)
      for (int q = 0; q < r->c->candidate[i].n * r->c->candidate[k].n; q++) {
        const candidate_t *const a = &r->c->candidate[i], *const b = &r->c->candidate[k];
        if (a->use.fx != b->use.fx && looks_like(r, a, q % a->n, b->first + q / a->n))
          join(found->alike, r->c->columns, a->first + q % a->n, b->first + q / a->n);
      }
}

done_t family_find(const round_t *r, bool measured, found_t *found, why_t *why) {
  unexplained_t u;
  find_alike(r, found);
  if (found->n == 0) return DONE;
  TRY(find_unexplained(r, &u, why));
  for (int i = 0; i < found->n; i++)
    if (choice_has(&r->choice, found->named[i].candidate))
      find_rivals(r, &u, measured, found, &found->named[i]);
  return weigh_names(r, found, why);
}
