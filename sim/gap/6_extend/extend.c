// extend.c - the vehicle file with what was named.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "gap/6_extend/extend.h"

#include "gap/5_infer/p_value.h"
#include "vehicle/model_file.h"
#include <stdlib.h>
#include <string.h>

static void write_list(FILE *out, const char *key, const double *v, int n) {
  fprintf(out, "%s = [", key);
  for (int i = 0; i < n; i++) fprintf(out, "%s%.9g", i ? ", " : "", v[i]);
  fputs("]\n", out);
}

// A curve from a file beside the vehicle file is not beside the new one: its points take its place.
static void write_text(const extend_job_t *job, FILE *out) {
  const fx_use_t *fx = job->model->fx, *const end = fx + job->model->n_fx;
  for (const char *line = job->text, *next; *line; line = next) {
    next = strchr(line, '\n');
    next = next ? next + 1 : line + strlen(line);
    const char *const key = line + strspn(line, " \t");
    const bool file = strncmp(key, "file", 4) == 0 && key[4 + strspn(key + 4, " \t")] == '=';
    while (file && fx < end && fx->points.n == 0) fx++;
    if (file && fx < end) {
      fprintf(out, "# was: ");
      fwrite(line, 1, strcspn(line, "\r\n"), out);
      fputc('\n', out);
      write_list(out, "distance_over_radius", fx->points.x, fx->points.n);
      write_list(out, "ratio", fx->points.ratio, fx->points.n);
      fx++;
    } else
      fwrite(line, 1, (size_t)(next - line), out);
  }
}

static const char *unit_in_words(const char *unit) {
  return unit[0] ? unit : "without unit";
}

static void write_effect(const extend_job_t *job, const named_t *named, FILE *out) {
  const fx_use_t *const use = found_use(job->found, named);
  const fx_t *const fx = use->fx;
  int n;
  char p[P_TEXT];
  const fx_param_t *param = fx_use_params(use, &n);
  fprintf(out,
          "\n# Found by the discrepancy workflow in %s: %s, %.3g %% of the gap.\n[[effect]]\nname = \"%s\"\n",
          job->logs, p_words(named->p, p), 100.0 * named->share, fx->name);
  if (use->form) fprintf(out, "form = \"%s\"\n", use->form->name);
  for (int i = 0; i < n; i++) {
    fprintf(out, "%s = %.9g", param[i].name, use->p[i]);
    const bool shape = fx->n_shape && fx->shape_param == i;
    bool estimated = false;
    for (int k = 0; k < fx->n_size; k++) {
      if (fx->size[k].param != i) continue;
      fprintf(out, " # %s, estimated, +- %.2g (standard error)\n", unit_in_words(param[i].unit),
              named->stderr_[k]);
      estimated = true;
    }
    if (estimated) continue;
    if (shape && named->shape_stderr > 0.0)
      fprintf(out, " # %s, estimated, +- %.2g (standard error)\n", unit_in_words(param[i].unit),
              named->shape_stderr);
    else
      fprintf(out, " # %s, %s\n", unit_in_words(param[i].unit),
              !shape                       ? "as the effect has it, not estimated"
              : isnan(named->shape_stderr) ? "estimated, standard error not known"
                                           : "the best of the shapes that were tried");
  }
}

// The new text must be what `fly --vehicle` reads.
static done_t check(const char *text, const extend_job_t *job, why_t *why) {
  model_t again;
  why_t cause;
  const done_t status = model_read_text("model.toml", text, &again, &cause);
  if (status == DONE) return DONE;
  return error_set(why, "%.200s: the named effects cannot be added to it: %.200s", job->path, cause.text);
}

done_t extend_write(const extend_job_t *job, FILE *out, why_t *why) {
  char *text = NULL;
  size_t size = 0;
  FILE *const made = open_memstream(&text, &size);
  if (!made) return error_failed(why, "out of memory");
  fprintf(made, "# Written by gap: %s and what was missing in it (%d named). Rewritten by the next run.\n",
          job->path, job->found->n);
  if (job->made) made_comment(job->made, made);
  if (job->made) fprintf(made, "# %s\n", job->logs);
  write_text(job, made);
  for (int i = 0; i < job->found->n; i++) write_effect(job, &job->found->named[i], made);
  done_t status = fclose(made) == 0 && text ? DONE : error_failed(why, "out of memory");
  if (status == DONE) status = check(text, job, why);
  if (status == DONE) fputs(text, out);
  free(text);
  return status;
}
