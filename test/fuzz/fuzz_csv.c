// fuzz_csv.c - any bytes as a CSV.
#include "fuzz/fuzz.h"
#include "rig/flight_csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static char good[40000];
  static size_t good_size;
  if (good_size == 0)
    good_size = flight_csv_write(&(flight_csv_t){.dt_ms = 20.0, .rows = 120}, good, sizeof good);
  fuzz_log((const uint8_t *)good, good_size, data, size);
  return 0;
}
