// usd_config.c - the uSD deck's config.txt.
#include "usd_config.h"

#include "base/number.h"
#include "sections.h"
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#define FIXED "fixedFrequency"

typedef struct {
  FILE *file;
  const char *path;
  int line;
  char text[USD_CONFIG_LINE]; // without white space and comments
} reader_t;

static done_t refuse(const reader_t *r, why_t *why, const char *what) {
  char shown[NUMBER_SHOWN];
  return error_set(why, "%s:%d: `%s`: %s", r->path, r->line, number_shown(r->text, shown), what);
}

// Reads the next line; one that is only a comment is skipped. *more: false at the end. A last line without
// its newline is refused, since the deck loses it.
static done_t next(reader_t *r, bool *more, why_t *why) {
  bool comment = false, pure = false;
  size_t n = 0;
  *more = true;
  r->line++;
  r->text[0] = '\0';
  for (int c; (c = getc(r->file)) != '\n' || pure;) {
    if (c == EOF) {
      *more = false;
      return ferror(r->file) ? error_set(why, "%s: cannot be read", r->path)
             : n > 0         ? refuse(r, why, "the last line; allowed: one that ends with a newline")
                             : DONE;
    }
    if (c == '\n') comment = pure = false, r->line++;
    if (isspace(c)) continue;
    if (c == '#' && n == 0) pure = true;
    comment = comment || c == '#';
    if (comment) continue;
    if (n == USD_CONFIG_LINE - 1) return refuse(r, why, "too long; the deck takes 31 characters a line");
    r->text[n++] = (char)c;
    r->text[n] = '\0';
  }
  return DONE;
}

static done_t take_whole(reader_t *r, int max, const char *allowed, int *value, why_t *why) {
  bool more;
  double number;
  TRY(next(r, &more, why));
  if (!more || !number_parse(r->text, &number) || !(number >= 0.0 && number <= (double)max) ||
      number != (double)(int)number)
    return refuse(r, why, allowed);
  *value = (int)number;
  return DONE;
}

static done_t take_head(reader_t *r, usd_config_t *config, why_t *why) {
  int version, at_start;
  bool more;
  TRY(take_whole(r, 1, "the version; allowed: 1", &version, why));
  if (version != 1) return refuse(r, why, "the version; allowed: 1");
  TRY(take_whole(r, 65535, "bytes of the buffer; allowed: a whole number up to 65535", &config->buffer_bytes,
                 why));
  TRY(next(r, &more, why));
  if (!more || r->text[0] == '\0' || strlen(r->text) > USD_CONFIG_FILE)
    return refuse(r, why, "the file's name; allowed: 1 to 10 characters");
  memcpy(config->file, r->text, strlen(r->text) + 1);
  TRY(take_whole(r, 1, "start with the power; allowed: 0, 1", &at_start, why));
  config->at_start = at_start == 1;
  return DONE;
}

static done_t take_event(reader_t *r, usd_config_t *config, why_t *why) {
  if (config->n == USD_CONFIG_EVENTS) return refuse(r, why, "one event too many; the deck takes 20");
  usd_config_event_t *const e = &config->event[config->n++];
  memcpy(e->name, r->text + 3, sizeof e->name - 3);
  e->line = r->line;
  if (strcmp(e->name, FIXED) != 0) return DONE;
  TRY(take_whole(r, 1000, "the frequency; allowed: 0 to 1000 Hz", &config->frequency_Hz, why));
  return take_whole(r, 2, "the mode; allowed: 0, 1, 2", &config->mode, why);
}

static done_t take_variable(const reader_t *r, usd_config_t *config, why_t *why) {
  if (config->n == 0) return refuse(r, why, "before any event; allowed: on:NAME");
  usd_config_event_t *const e = &config->event[config->n - 1];
  if (e->n == USD_CONFIG_VARIABLES)
    return refuse(r, why, "one variable too many; the deck takes 20 an event");
  memcpy(e->variable[e->n], r->text, sizeof r->text);
  e->at[e->n++] = r->line;
  return DONE;
}

static done_t read(reader_t *r, usd_config_t *config, why_t *why) {
  TRY(take_head(r, config, why));
  for (bool more;;) {
    TRY(next(r, &more, why));
    if (!more) break;
    if (r->text[0] == '\0') continue;
    const bool event = strncmp(r->text, "on:", 3) == 0;
    TRY(event ? take_event(r, config, why) : take_variable(r, config, why));
  }
  if (config->n == 0) return error_set(why, "%s: no event; allowed: one on:NAME or more", r->path);
  return DONE;
}

done_t usd_config_read(const char *path, usd_config_t *config, why_t *why) {
  reader_t r = {.path = path, .file = fopen(path, "rb")};
  *config = (usd_config_t){.n = 0};
  if (!r.file) return error_set(why, "%s: cannot be opened: %s", path, strerror(errno));
  const done_t status = read(&r, config, why);
  fclose(r.file);
  return status;
}

done_t usd_config_check(const char *path, const usd_config_t *config, why_t *why) {
  char shown[NUMBER_SHOWN];
  for (int i = 0; i < config->n; i++) {
    const usd_config_event_t *const e = &config->event[i];
    if (strcmp(e->name, FIXED) != 0 && !sections_event(e->name))
      return error_set(why, "%s:%d: on:%s: the app triggers no such event", path, e->line,
                       number_shown(e->name, shown));
    for (int k = 0; k < e->n; k++)
      if (!sections_log(e->variable[k]))
        return error_set(why, "%s:%d: %s: the app has no such log; allowed: those of fly --logs", path,
                         e->at[k], number_shown(e->variable[k], shown));
  }
  return DONE;
}
