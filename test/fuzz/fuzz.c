// fuzz.c - stage 1 of the workflow on any bytes.
#define _GNU_SOURCE // memfd_create
#include "fuzz/fuzz.h"

#include "gap/1_read/flight.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static const model_t *vehicle(void) {
  static model_t m;
  why_t why;
  if (m.mass_kg == 0.0 && model_builtin("cf21_legacy", &m, &why) != DONE) abort();
  return &m;
}

static void judge(const gap_flight_t *f) {
  if (f->n < 1 || !(f->rate_Hz > 0.0) || f->n_note > GAP_NOTES) abort();
  for (int i = 0; i < f->n; i++) {
    if (!isfinite(f->t_s[i]) || (i > 0 && !(f->t_s[i] > f->t_s[i - 1]))) abort();
    for (int s = 0; s < SIG_COUNT; s++)
      if (f->v[s] && isinf(f->v[s][i])) abort();
  }
}

static void read_log(const uint8_t *log, size_t size) {
  const int file = memfd_create("log", 0);
  char path[64];
  if (file < 0 || (size > 0 && write(file, log, size) != (ssize_t)size)) abort();
  snprintf(path, sizeof path, "/proc/self/fd/%d", file);
  const columns_t columns = columns_crazyflie();
  gap_flight_t f;
  why_t why = {""};
  if (gap_read(&f, path, &columns, vehicle(), &why) == DONE)
    judge(&f);
  else if (why.text[0] == '\0' || f.n != 0 || f.t_s || strchr(why.text, '\n'))
    abort();
  gap_flight_free(&f);
  close(file);
}

void fuzz_log(const uint8_t *good, size_t good_size, const uint8_t *data, size_t size) {
  if (size == 0) return;
  const uint8_t kind = data[0] % 3, *const rest = data + 1;
  uint8_t *const log = malloc(good_size + size);
  if (!log) abort();
  size_t n = kind == 0 ? 0 : good_size;
  memcpy(log, good, n);
  for (size_t i = 0; kind == 2 && i + 3 < size; i += 3)
    log[(rest[i] | (size_t)rest[i + 1] << 8) % good_size] = rest[i + 2];
  if (kind != 2) {
    memcpy(log + n, rest, size - 1);
    n += size - 1;
  }
  read_log(log, n);
  free(log);
}
