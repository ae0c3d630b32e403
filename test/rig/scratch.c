// scratch.c - small files for tests.
#define _XOPEN_SOURCE 700 // mkdtemp, nftw
#include "rig/scratch.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char folder[256];

static int remove_one(const char *path, const struct stat *s, int type, struct FTW *at) {
  (void)s, (void)type, (void)at;
  return remove(path);
}

static void remove_all(void) {
  nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

const char *scratch_path(const char *name) {
  static char path[400];
  if (folder[0] == '\0') {
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/flight-test-XXXXXX", base && base[0] ? base : "/tmp");
    if (!mkdtemp(folder)) abort();
    atexit(remove_all);
  }
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

const char *scratch_file(const char *name, const char *text, long size) {
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "wb");
  if (!file) abort();
  fwrite(text, 1, size < 0 ? strlen(text) : (size_t)size, file);
  if (fclose(file) != 0) abort();
  return path;
}

char *scratch_text(const char *name) {
  FILE *const file = fopen(scratch_path(name), "rb");
  char *const text = calloc(1, 1u << 20);
  if (!text) abort();
  if (file) text[fread(text, 1, (1u << 20) - 1, file)] = '\0';
  if (file) fclose(file);
  return text;
}

const char *scratch_short(const char *text) {
  const size_t size = strlen(folder);
  return size > 0 && strncmp(text, folder, size) == 0 && text[size] == '/' ? text + size + 1 : text;
}
