// fuzz_usd.c - any bytes as a uSD log.
#include "fuzz/fuzz.h"
#include "rig/flight_csv.h"
#include "rig/usd_bytes.h"

#include <stdio.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void put_event(usd_bytes_t *b, unsigned id, const char *event, int from, int to) {
  usd_put(b, id, 2);
  usd_put_name(b, event);
  usd_put(b, (unsigned)(to - from), 2);
  for (int c = from; c < to; c++) {
    char name[40];
    snprintf(name, sizeof name, "%s(f)", flight_csv_name[c]);
    usd_put_name(b, name);
  }
}

static void put_record(usd_bytes_t *b, unsigned id, uint64_t us, int from, int to) {
  double v[FC_COLUMNS];
  flight_csv_values(1e-6 * (double)us, v);
  usd_put(b, id, 2);
  usd_put(b, us, 8);
  for (int c = from; c < to; c++) usd_put_float(b, (float)v[c]);
}

// Two events; with the first one's name changed the reader takes both.
static void put_good(usd_bytes_t *b) {
  usd_put(b, 0xBC, 1);
  usd_put(b, 2, 2);
  usd_put(b, 2, 2);
  put_event(b, 0, "fixedFrequency", FC_X, FC_GX);
  put_event(b, 1, "other", FC_GX, FC_COLUMNS);
  for (unsigned i = 0; i < 120; i++) {
    put_record(b, 0, 20000 * i, FC_X, FC_GX);
    put_record(b, 1, 20000 * i, FC_GX, FC_COLUMNS);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static usd_bytes_t good;
  if (good.n == 0) put_good(&good);
  fuzz_log(good.byte, good.n, data, size);
  return 0;
}
