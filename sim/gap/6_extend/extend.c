// extend.c - the vehicle file with what was named.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "gap/6_extend/extend.h"

#include "gap/6_extend/p_value.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void write_list(FILE *out, const char *key, const double *v, int n) {
  fprintf(out, "%s = [", key);
  for (int i = 0; i < n; i++) fprintf(out, "%s%.9g", i ? ", " : "", v[i]);
  fputs("]\n", out);
}

static void write_points(FILE *out, const curve_points_t *points) {
  write_list(out, "distance_over_radius", points->x, points->n);
  write_list(out, "ratio", points->ratio, points->n);
}

// --- effects that the file has with other numbers ---------------------------------------------------------

static bool is_about(const extend_job_t *job, int name, const fx_t *fx) {
  return found_use(job->found, &job->found->named[name])->fx == fx;
}

// True if one of the first n names is about fx.
static bool is_among(const extend_job_t *job, int n, const fx_t *fx) {
  for (int i = 0; i < n; i++)
    if (is_about(job, i, fx)) return true;
  return false;
}

static bool is_named(const extend_job_t *job, const fx_t *fx) {
  return is_among(job, job->found->n, fx);
}

static const char *next_line(const char *line) {
  const char *const end = strchr(line, '\n');
  return end ? end + 1 : line + strlen(line);
}

static const char *after_blanks(const char *line) {
  return line + strspn(line, " \t");
}

// Returns the end of a table that begins at `line`: where the next one begins.
static const char *table_end(const char *line) {
  do line = next_line(line);
  while (*line && *after_blanks(line) != '[');
  return line;
}

// True if the `name = "..."` of a table is that of an effect that was named.
static bool is_of_a_name(const extend_job_t *job, const char *from, const char *to) {
  for (const char *line = from; line < to; line = next_line(line)) {
    const char *const key = after_blanks(line);
    const char *const quote = strncmp(key, "name", 4) == 0 ? strpbrk(key, "\"'\n") : NULL;
    const size_t length = quote && *quote != '\n' ? strcspn(quote + 1, "\"'\n") : 0;
    char name[32] = "";
    if (length < sizeof name) memcpy(name, quote ? quote + 1 : "", length);
    const fx_t *const fx = length ? fx_find(name) : NULL;
    if (fx) return is_named(job, fx);
  }
  return false;
}

// Returns the text without the effects that are written anew; free it. Null: no memory.
static char *without_names(const extend_job_t *job) {
  char *text = NULL;
  size_t size = 0;
  FILE *const kept = open_memstream(&text, &size);
  if (!kept) return NULL;
  for (const char *line = job->text; *line;) {
    const bool effect = strncmp(after_blanks(line), "[[effect]]", 10) == 0;
    const char *const end = effect ? table_end(line) : next_line(line);
    if (!effect || !is_of_a_name(job, line, end)) fwrite(line, 1, (size_t)(end - line), kept);
    line = end;
  }
  return fclose(kept) == 0 ? text : NULL;
}

// Writes the text. A curve's file is not beside the new vehicle file, so its points take its place.
static void write_text(const extend_job_t *job, const char *text, FILE *out) {
  const fx_use_t *fx = job->model->fx, *const end = fx + job->model->n_fx;
  for (const char *line = text, *next; *line; line = next) {
    next = next_line(line);
    const char *const key = after_blanks(line);
    const bool file = strncmp(key, "file", 4) == 0 && *after_blanks(key + 4) == '=';
    while (file && fx < end && (fx->points.n == 0 || is_named(job, fx->fx))) fx++;
    if (file && fx < end) {
      fprintf(out, "# was: ");
      fwrite(line, 1, strcspn(line, "\r\n"), out);
      fputc('\n', out);
      write_points(out, &fx->points);
      fx++;
    } else
      fwrite(line, 1, (size_t)(next - line), out);
  }
}

// --- the names --------------------------------------------------------------------------------------------

// Returns the largest standard error of number k: two names may be about one effect, each about other
// numbers. 0: no name shows it.
static double stderr_of(const extend_job_t *job, const fx_t *fx, int k) {
  double most = 0.0;
  for (int i = 0; i < job->found->n; i++)
    if (is_about(job, i, fx)) most = fmax(most, job->found->named[i].stderr_[k]);
  return most;
}

// True if a name is about the group of numbers (fx->size_apart) to which k belongs.
static bool is_of_a_lot(const extend_job_t *job, const fx_t *fx, int k) {
  bool of = false;
  for (int other = 0; other < fx->n_size; other++)
    of = of || ((other < fx->size_apart) == (k < fx->size_apart) && stderr_of(job, fx, other) > 0.0);
  return of || !fx->size_apart;
}

// Writes where a number comes from.
static void write_source(const extend_job_t *job, const fx_use_t *use, const named_t *named, int param,
                         FILE *out) {
  const fx_use_t *const in_file = model_fx(job->model, use->fx);
  const bool shape = fx_use_has_shape(use) && use->fx->shape_param == param;
  for (int k = 0; k < use->fx->n_size; k++) {
    if (use->fx->size[k].param != param) continue;
    const double error = stderr_of(job, use->fx, k);
    if (error > 0.0)
      fprintf(out, "estimated, +- %.2g (standard error)", error);
    else
      fputs(is_of_a_lot(job, use->fx, k) ? "not shown by what can be compared of these flights"
                                         : "no name is about it",
            out);
    if (in_file) fprintf(out, "; %s has %.9g", job->path, fx_use_size(in_file, k));
    return;
  }
  if (shape && in_file)
    fprintf(out, "as %s has it", job->path);
  else if (shape && named->shape_stderr > 0.0)
    fprintf(out, "estimated, +- %.2g (standard error)", named->shape_stderr);
  else
    fputs(!shape                       ? "as the effect has it, not estimated"
          : isnan(named->shape_stderr) ? "estimated, standard error not known"
                                       : "the best of the shapes that were tried",
          out);
}

static void write_effect(const extend_job_t *job, const model_t *extended, const named_t *named, FILE *out) {
  const fx_use_t use = *model_fx(extended, found_use(job->found, named)->fx);
  double share = 0.0;
  int n;
  for (int i = 0; i < job->found->n; i++)
    share += is_about(job, i, use.fx) ? job->found->named[i].share : 0.0;
  char p[P_TEXT];
  const fx_param_t *param = fx_use_params(&use, &n);
  fprintf(out,
          "\n# Found by the discrepancy workflow in %s: %s, %.3g %% of the gap.\n[[effect]]\nname = \"%s\"\n",
          job->logs, p_words(named->p, p), 100.0 * share, use.fx->name);
  if (use.form) fprintf(out, "form = \"%s\"\n", use.form->name);
  if (use.points.n) write_points(out, &use.points);
  for (int i = 0; i < n; i++) {
    const char *const unit = param[i].unit[0] ? param[i].unit : "without unit";
    fprintf(out, "%s = %.9g # %s, ", param[i].name, use.p[i], unit);
    write_source(job, &use, named, i, out);
    fputc('\n', out);
  }
}

// The new text must be one that `fly --vehicle` reads.
static done_t check(const char *text, const extend_job_t *job, why_t *why) {
  model_t again;
  why_t cause;
  const done_t status = model_read_text("model.toml", text, &again, &cause);
  if (status == DONE) return DONE;
  return error_set(why, "%.200s: the named effects cannot be added to it: %.200s", job->path, cause.text);
}

done_t extend_write(const extend_job_t *job, FILE *out, why_t *why) {
  model_t extended;
  TRY(chosen_model(&job->found->chosen, job->model, &extended, why));
  char *text = NULL;
  size_t size = 0;
  FILE *const made = open_memstream(&text, &size);
  if (!made) return error_failed(why, "out of memory");
  fprintf(made, "# Written by gap: %s and what was missing in it (%d named). Rewritten by the next run.\n",
          job->path, job->found->n);
  if (job->made) made_comment(job->made, made);
  if (job->made) fprintf(made, "# %s\n", job->logs);
  char *const kept = without_names(job);
  if (kept) write_text(job, kept, made);
  free(kept);
  for (int i = 0; i < job->found->n; i++)
    if (!is_among(job, i, found_use(job->found, &job->found->named[i])->fx))
      write_effect(job, &extended, &job->found->named[i], made);
  done_t status = fclose(made) == 0 && text && kept ? DONE : error_failed(why, "out of memory");
  if (status == DONE) status = check(text, job, why);
  if (status == DONE) fputs(text, out);
  free(text);
  return status;
}
