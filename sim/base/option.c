// option.c - errors of a program's options.
#include "base/option.h"

#include "base/nearest.h"
#include "base/number.h"
#include <stdio.h>
#include <string.h>

#define LIST_MAX 320

// The option of that name; null if there is none.
static const struct option *find(const struct option *options, const char *name, size_t size) {
  for (; options->name; options++)
    if (strlen(options->name) == size && strncmp(options->name, name, size) == 0) return options;
  return NULL;
}

static void list(const struct option *options, char text[LIST_MAX]) {
  size_t used = 0;
  for (const struct option *o = options; o->name && used < LIST_MAX; o++)
    used += (size_t)snprintf(text + used, LIST_MAX - used, "%s--%s", o == options ? "" : ", ", o->name);
}

done_t option_refuse(const struct option *options, const char *typed, why_t *why) {
  char shown[NUMBER_SHOWN], text[LIST_MAX] = "", hint[NEAREST_HINT], word[NEAREST_LETTERS + 1] = "";
  const char *const name = typed + strspn(typed, "-");
  const size_t size = strcspn(name, "=");
  const struct option *const meant = find(options, name, size);
  if (meant && meant->has_arg == required_argument)
    return error_set(why, "--%s: its value is missing; allowed: --%s VALUE", meant->name, meant->name);
  if (meant) return error_set(why, "--%s: takes no value; allowed: --%s", meant->name, meant->name);
  list(options, text);
  if (size < sizeof word) memcpy(word, name, size);
  nearest_t nearest = nearest_to(word);
  for (const struct option *o = options; o->name; o++) nearest_try(&nearest, o->name);
  char dashes[NEAREST_LETTERS + 3];
  if (nearest.name) {
    snprintf(dashes, sizeof dashes, "--%s", nearest.name);
    nearest.name = dashes;
  }
  return error_set(why, "%s: not an option%s; allowed: %s", number_shown(typed, shown),
                   nearest_hint(&nearest, hint), text);
}
