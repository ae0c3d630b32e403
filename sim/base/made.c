// made.c - how a file was made.
#define _POSIX_C_SOURCE 200809L // gmtime_r
#include "base/made.h"

#include "base/version.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PLAIN "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%^"

// SOURCE_DATE_EPOCH makes builds repeatable (reproducible-builds.org); if it is not a number it is ignored.
static time_t now(void) {
  const char *const epoch = getenv("SOURCE_DATE_EPOCH");
  char *end;
  if (!epoch || !epoch[0]) return time(NULL);
  errno = 0;
  const long long set = strtoll(epoch, &end, 10);
  return *end == '\0' && errno == 0 && set >= 0 && set < 253402300800 ? (time_t)set : time(NULL);
}

static size_t quoted_size(const char *word) {
  size_t size = strlen(word) + 3;
  for (; *word; word++) size += *word == '\'' ? 3 : 0;
  return size;
}

static void quote(const char *word, char *to) {
  if (word[0] && word[strspn(word, PLAIN)] == '\0') {
    memcpy(to, word, strlen(word) + 1);
    return;
  }
  *to++ = '\'';
  for (; *word; word++) {
    if (*word != '\'') {
      *to++ = *word;
      continue;
    }
    memcpy(to, "'\\''", 4);
    to += 4;
  }
  memcpy(to, "'", 2);
}

static char *room(made_t *m, size_t size) {
  const size_t used = m->command ? strlen(m->command) : 0;
  char *const more = realloc(m->command, used + size + 2);
  if (!more) return NULL;
  m->command = more;
  if (used) more[used] = ' ';
  return more + used + (used > 0);
}

void made_word(made_t *m, const char *word) {
  char *const end = room(m, quoted_size(word));
  if (end) quote(word, end);
}

void made_words(made_t *m, const char *words) {
  char *const end = words ? room(m, strlen(words)) : NULL;
  if (end) memcpy(end, words, strlen(words) + 1);
}

void made_option(made_t *m, const char *name, const char *value) {
  char word[40];
  snprintf(word, sizeof word, "--%s", name);
  made_word(m, word);
  if (value) made_word(m, value);
}

made_t made_by(const char *program, int argc, char *const *argv) {
  made_t m = {.command = NULL};
  struct tm utc;
  const time_t t = now();
  snprintf(m.by, sizeof m.by, "%s %s", program, version_text);
  if (gmtime_r(&t, &utc)) strftime(m.date, sizeof m.date, "%Y-%m-%dT%H:%M:%SZ", &utc);
  made_word(&m, program);
  for (int i = 1; i < argc; i++) made_word(&m, argv[i]);
  return m;
}

void made_free(made_t *m) {
  free(m->command);
  m->command = NULL;
}

void made_add(cJSON *json, const made_t *m, double seed, double rows) {
  cJSON *const made = cJSON_AddObjectToObject(json, "made");
  cJSON_AddStringToObject(made, "by", m->by);
  cJSON_AddStringToObject(made, "command", m->command ? m->command : "");
  cJSON_AddStringToObject(made, "date", m->date);
  cJSON_AddNumberToObject(made, "seed", seed); // NaN becomes null
  cJSON_AddNumberToObject(made, "rows", rows);
}

void made_line(const made_t *m, FILE *out) {
  for (const char *c = m->command ? m->command : ""; *c; c++) fputc(*c >= ' ' && *c <= '~' ? *c : '?', out);
}

void made_comment(const made_t *m, FILE *out) {
  fprintf(out, "# made by %s at %s\n# ", m->by, m->date);
  made_line(m, out);
  fputc('\n', out);
}

void made_version(const char *program) {
  printf("%s %s\n", program, version_text);
}
