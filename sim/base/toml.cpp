// toml.cpp - TOML files through toml++. No exception leaves this file.
#define TOML_HEADER_ONLY 0 // uses the compiled library, which compiles in a fraction of the time
#include "base/toml.h"

#include "base/nearest.h"
#include "base/text.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <system_error>
#include <cerrno>
#include <toml++/toml.h>

struct toml_file {
  std::string path;
  const toml_kind_t *kind;
  toml::table root;
};

namespace {

const toml::table &table_of(toml_t t) {
  return *static_cast<const toml::table *>(t.table);
}

toml_t handle(const toml_file_t *file, const toml::table *table) {
  return {file, table};
}

// The value of the key; if it is missing, a null pointer and an error.
const toml::node *find(toml_t t, const char *key, const char *type, why_t *why) {
  const toml::node *node = table_of(t).get(key);
  if (!node) toml_refuse(t, key, why, "missing; allowed: %s", type);
  return node;
}

done_t wrong_type(toml_t t, const char *key, const char *type, why_t *why) {
  return toml_refuse(t, key, why, "wrong type; allowed: %s", type);
}

// Lists the keys allowed at the root: name, mass_kg, ..
std::string keys_of(const toml_kind_t *kind) {
  std::string list;
  for (const char *const *key = kind->keys; *key; key++)
    list += (list.empty() ? "" : ", ") + std::string(*key);
  return list;
}

done_t parse(toml_file_t &file, std::istream &stream, const toml_kind_t *kind, why_t *why) {
  try {
    file.root = toml::parse(stream, file.path);
  } catch (const toml::parse_error &e) {
    const std::string what(e.description());
    return error_set(why, "%s:%u:%u: %s; allowed: %s in TOML (as %s) with %s", file.path.c_str(),
                     e.source().begin.line, e.source().begin.column, what.c_str(), kind->what, kind->example,
                     keys_of(kind).c_str());
  }
  return DONE;
}

done_t read(toml_file_t &file, const char *text, const toml_kind_t *kind, why_t *why) {
  if (text) {
    std::istringstream stream(text);
    return parse(file, stream, kind, why);
  }
  std::ifstream stream(file.path, std::ios::binary);
  const int cause = errno;
  if (!stream) return error_set(why, "%s: cannot be opened: %s", file.path.c_str(), std::strerror(cause));
  errno = 0;
  stream.peek();
  if (errno != 0) return error_set(why, "%s: cannot be read: %s", file.path.c_str(), std::strerror(errno));
  return parse(file, stream, kind, why);
}

done_t open(toml_file_t **file, const char *path, const char *text, const toml_kind_t *kind, why_t *why) {
  *file = nullptr;
  try {
    toml_file_t *const fresh = new toml_file_t{path, kind, {}};
    const done_t status = read(*fresh, text, kind, why);
    if (status == DONE)
      *file = fresh;
    else
      delete fresh;
    return status;
  } catch (const std::exception &e) {
    return error_set(why, "%s: %s", path, e.what());
  }
}

} // namespace

done_t toml_open(toml_file_t **file, const char *path, const toml_kind_t *kind, why_t *why) {
  return open(file, path, nullptr, kind, why);
}

done_t toml_open_text(toml_file_t **file, const char *path, const char *text, const toml_kind_t *kind,
                      why_t *why) {
  return open(file, path, text, kind, why);
}

void toml_close(toml_file_t *file) {
  delete file;
}

toml_t toml_root(const toml_file_t *file) {
  return handle(file, &file->root);
}

bool toml_has(toml_t t, const char *key) {
  return table_of(t).contains(key);
}

done_t toml_refuse(toml_t t, const char *key, why_t *why, const char *format, ...) {
  char what[480];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  const toml::node *node = key ? table_of(t).get(key) : nullptr;
  // A root table has no position of its own: line 1.
  const unsigned table_line = table_of(t).source().begin.line;
  const unsigned line = node ? node->source().begin.line : table_line ? table_line : 1;
  return error_set(why, "%s:%u: %s%s%s", t.file->path.c_str(), line, key ? key : "", key ? ": " : "", what);
}

done_t toml_string(toml_t t, const char *key, char *text, size_t size, why_t *why) {
  const toml::node *node = find(t, key, "a text in quotes", why);
  if (!node) return BAD_INPUT;
  const toml::value<std::string> *value = node->as_string();
  if (!value) return wrong_type(t, key, "a text in quotes", why);
  const std::string &s = value->get();
  if (s.size() >= size || s.find('\0') != std::string::npos)
    return toml_refuse(t, key, why, "the text is too long; allowed: %zu bytes", size - 1);
  std::memcpy(text, s.c_str(), s.size() + 1);
  return DONE;
}

done_t toml_double(toml_t t, const char *key, double min, double max, double *value, why_t *why) {
  const toml::node *node = find(t, key, "a number", why);
  if (!node) return BAD_INPUT;
  if (!node->is_number()) return wrong_type(t, key, "a number", why);
  const double x = *node->value<double>();
  if (!(x >= min && x <= max) || std::isinf(x))
    return toml_refuse(t, key, why, "%g is out of range; allowed: %g to %g", x, min, max);
  *value = x;
  return DONE;
}

done_t toml_bool(toml_t t, const char *key, bool *value, why_t *why) {
  const toml::node *node = find(t, key, "true or false", why);
  if (!node) return BAD_INPUT;
  const toml::value<bool> *truth = node->as_boolean();
  if (!truth) return wrong_type(t, key, "true or false", why);
  *value = truth->get();
  return DONE;
}

done_t toml_doubles(toml_t t, const char *key, int n_max, double *values, int *n, why_t *why) {
  const toml::node *node = find(t, key, "a list of numbers", why);
  if (!node) return BAD_INPUT;
  const toml::array *list = node->as_array();
  if (!list) return wrong_type(t, key, "a list of numbers", why);
  if (list->size() > static_cast<size_t>(n_max))
    return toml_refuse(t, key, why, "%zu numbers; allowed: at most %d", list->size(), n_max);
  for (const toml::node &item : *list)
    if (!item.is_number() || !std::isfinite(*item.value<double>()))
      return wrong_type(t, key, "a list of numbers", why);
  *n = 0;
  for (const toml::node &item : *list) values[(*n)++] = *item.value<double>();
  return DONE;
}

done_t toml_table(toml_t t, const char *key, toml_t *sub, why_t *why) {
  const toml::node *node = find(t, key, "a table", why);
  if (!node) return BAD_INPUT;
  const toml::table *table = node->as_table();
  if (!table) return wrong_type(t, key, "a table", why);
  *sub = handle(t.file, table);
  return DONE;
}

done_t toml_table_at(toml_t t, const char *key, int i, toml_t *sub, bool *more, why_t *why) {
  *more = false;
  const toml::node *node = table_of(t).get(key);
  if (!node) return DONE;
  const toml::array *list = node->as_array();
  if (!list) return wrong_type(t, key, "tables, each under [[...]]", why);
  if (static_cast<size_t>(i) >= list->size()) return DONE;
  const toml::table *table = list->get(static_cast<size_t>(i))->as_table();
  if (!table) return wrong_type(t, key, "tables, each under [[...]]", why);
  *sub = handle(t.file, table);
  *more = true;
  return DONE;
}

const char *toml_key(toml_t t, int i) {
  const toml::table &table = table_of(t);
  if (i < 0 || static_cast<size_t>(i) >= table.size()) return nullptr;
  return std::next(table.begin(), i)->first.data();
}

const char *toml_astray(toml_t t, const char *key) {
  for (const char *const *own = t.file->kind->keys; *own && t.table != &t.file->root; own++)
    if (std::strcmp(*own, key) == 0) return " (a key of the file itself stands before the first [table])";
  return "";
}

done_t toml_only(toml_t t, const char *const *allowed, why_t *why) {
  for (int i = 0; const char *key = toml_key(t, i); i++) {
    bool known = false;
    for (const char *const *a = allowed; *a; a++) known = known || std::strcmp(*a, key) == 0;
    if (known) continue;
    char list[320] = "";
    for (const char *const *a = allowed; *a; a++)
      text_add(list, sizeof list, "%s%s", a == allowed ? "" : ", ", *a);
    char hint[NEAREST_HINT];
    return toml_refuse(t, key, why, "unknown key%s; allowed: %s%s", nearest_of(key, allowed, hint), list,
                       toml_astray(t, key));
  }
  return DONE;
}
