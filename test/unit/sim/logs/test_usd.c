// test_usd.c - uSD logs: what is read, and what happens to damaged ones (row 57 of the faults).
#include "gap/1_read/flight.h"
#include "logs/usd.h"
#include "rig/flight_csv.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "rig/usd_bytes.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

static done_t open_bytes(usd_file_t **file, const usd_bytes_t *b, why_t *why) {
  const char *const path = scratch_file("u.bin", (const char *)b->byte, (long)b->n);
  FILE *const stream = fopen(path, "rb");
  if (!stream) return error_failed(why, "no file");
  return usd_open(file, stream, "u.bin", why);
}

static void put_head(usd_bytes_t *b, unsigned version, unsigned events) {
  usd_put(b, 0xBC, 1);
  usd_put(b, version, 2);
  usd_put(b, events, 2);
}

static void put_stamp(usd_bytes_t *b, unsigned version, unsigned id, uint64_t ms) {
  usd_put(b, id, 2);
  usd_put(b, version == 1 ? ms : 1000 * ms, version == 1 ? 4 : 8);
}

TEST(usd_reads_every_type_of_both_versions) {
  for (unsigned version = 1; version <= 2; version++) {
    ROW("version %u", version);
    usd_bytes_t b = {0};
    put_head(&b, version, 2);
    usd_put(&b, 7, 2), usd_put_name(&b, "other"), usd_put(&b, 1, 2), usd_put_name(&b, "o.x(I)");
    usd_put(&b, 9, 2), usd_put_name(&b, "fixedFrequency"), usd_put(&b, 8, 2);
    static const char *const name[] = {"a.B(B)", "a.b(b)", "a.H(H)", "a.h(h)",
                                       "a.I(I)", "a.i(i)", "a.f(f)", "a.e(e)"};
    for (int k = 0; k < 8; k++) usd_put_name(&b, name[k]);
    put_stamp(&b, version, 7, 1), usd_put(&b, 5, 4); // another event between
    put_stamp(&b, version, 9, 12);
    usd_put(&b, 200, 1), usd_put(&b, (uint64_t)-100, 1), usd_put(&b, 60000, 2),
        usd_put(&b, (uint64_t)-30000, 2);
    usd_put(&b, 4000000000u, 4), usd_put(&b, (uint64_t)-2000000000, 4), usd_put_float(&b, 1.5f),
        usd_put(&b, 0xC100, 2);
    usd_put_crc(&b);
    static const double want[] = {200.0, -100.0, 60000.0, -30000.0, 4e9, -2e9, 1.5, -2.5};
    usd_file_t *file;
    why_t why = {""};
    CHECK_OK(open_bytes(&file, &b, &why));
    CHECK_TEXT(why.text, "");
    CHECK(usd_next(file));
    CHECK_NEAR(usd_value(file, usd_find(file, "timestamp")), 12.0, 0.0);
    for (int k = 0; k < 8; k++) {
      char column[8] = {0};
      memcpy(column, name[k], 3);
      CHECK_NEAR(usd_value(file, usd_find(file, column)), want[k], 0.0);
    }
    CHECK(usd_find(file, "o.y") == -1);
    CHECK(!usd_next(file) && usd_damage(file) == NULL);
    usd_close(file);
    usd_bytes_free(&b);
  }
}

// A file of `rows` records of one float, 10 ms apart.
static void put_file(usd_bytes_t *b, int rows) {
  put_head(b, 2, 1);
  usd_put(b, 0, 2), usd_put_name(b, "fixedFrequency"), usd_put(b, 1, 2), usd_put_name(b, "a.x(f)");
  for (int i = 0; i < rows; i++) put_stamp(b, 2, 0, (uint64_t)(10 * i)), usd_put_float(b, (float)i);
  usd_put_crc(b);
}

#define HEAD   (1 + 2 + 2 + 2 + 15 + 2 + 7)
#define RECORD (2 + 8 + 4)

static const struct {
  const char *what;
  size_t keep; // bytes; 0: all
  size_t at;   // a byte that is changed, 0: none
  unsigned char to;
  int rows; // that are read; -1: refused
  const char *want;
} damaged[] = {
    {"whole", 0, 0, 0, 10, NULL},
    {"cut in a record", HEAD + 5 * RECORD + 7, 0, 0, 5, "byte 101, behind record 5: the file is cut off"},
    {"cut in the CRC", HEAD + 10 * RECORD + 2, 0, 0, 9, "byte 157, behind record 9: the file is cut off"},
    {"a bit of a value", 0, HEAD + 3 * RECORD + 12, 0x55, 10,
     "byte 171, behind record 10: the CRC is wrong: something before is not as it was written"},
    {"an event of no name", 0, HEAD + 3 * RECORD, 0x55, 3,
     "byte 73, behind record 3: a record of an event that the header does not name"},
    {"time runs back", 0, HEAD + 5 * RECORD + 3, 0, 5,
     "byte 111, behind record 6: time runs back within an event"},
    {"empty", 1, 0, 0, -1, "u.bin: byte 0: the file is cut off in its header"},
    {"cut in the header", HEAD - 9, 0, 0, -1, "u.bin: byte 18: the file is cut off in its header"},
    {"version 3", 0, 1, 3, -1, "u.bin: byte 3: not a uSD log of version 1 or 2"},
    {"a type that is none", 0, HEAD - 3, 'q', -1,
     "u.bin: byte 31: variable `a.x(q)`: unknown type; allowed: NAME(T) with T one of BbHhIife"},
    {"events without end", 0, 4, 0xff, -1, "u.bin: byte 5: number of events; allowed: 1 to 64"},
    {"variables without end", 0, HEAD - 8, 0xff, -1, "u.bin: byte "},
};

TEST(usd_hands_out_what_is_before_a_damage_and_says_where_it_is) {
  for (unsigned i = 0; i < sizeof damaged / sizeof *damaged; i++) {
    ROW("%s", damaged[i].what);
    usd_bytes_t b = {0};
    put_file(&b, 10);
    if (damaged[i].keep) b.n = damaged[i].keep;
    if (damaged[i].at) b.byte[damaged[i].at] = damaged[i].to;
    usd_file_t *file;
    why_t why = {""};
    CHECK_STATUS(damaged[i].rows < 0 ? BAD_INPUT : DONE, open_bytes(&file, &b, &why));
    usd_bytes_free(&b);
    if (damaged[i].rows < 0) {
      CHECK(file == NULL);
      if (strncmp(why.text, damaged[i].want, strlen(damaged[i].want)) != 0)
        CHECK_TEXT(why.text, damaged[i].want);
      continue;
    }
    int rows = 0;
    for (; usd_next(file); rows++) CHECK_NEAR(usd_value(file, 0), 10.0 * rows, 0.0);
    CHECK_NEAR(rows, damaged[i].rows, 0.0);
    CHECK_TEXT(usd_damage(file) ? usd_damage(file) : "none", damaged[i].want ? damaged[i].want : "none");
    usd_close(file);
  }
}

TEST(usd_merges_events_of_rates_of_their_own_by_time) {
  usd_bytes_t b = {0};
  put_head(&b, 2, 2);
  usd_put(&b, 0, 2), usd_put_name(&b, "estAcceleration"), usd_put(&b, 1, 2), usd_put_name(&b, "acc.z(f)");
  usd_put(&b, 1, 2), usd_put_name(&b, "estGyroscope"), usd_put(&b, 1, 2), usd_put_name(&b, "gyro.z(f)");
  // Written a little out of order: the second event lags by three records.
  for (int i = 0; i < 203; i++) {
    if (i < 200) put_stamp(&b, 2, 0, (uint64_t)(10 * i)), usd_put_float(&b, 1.0f);
    if (i >= 3) put_stamp(&b, 2, 1, (uint64_t)(10 * (i - 3) + 4)), usd_put_float(&b, 2.0f);
  }
  usd_put_crc(&b);
  usd_file_t *file;
  why_t why = {""};
  CHECK_OK(open_bytes(&file, &b, &why));
  int rows = 0, acc = 0;
  double last_ms = -1.0;
  for (; usd_next(file); rows++) {
    CHECK(usd_value(file, 0) > last_ms);
    last_ms = usd_value(file, 0);
    const bool is_acc = usd_value(file, usd_find(file, "acc.z")) == 1.0;
    CHECK(isnan(usd_value(file, usd_find(file, is_acc ? "gyro.z" : "acc.z"))));
    acc += is_acc;
  }
  CHECK(rows == 400 && acc == 200 && usd_damage(file) == NULL);
  usd_close(file);
  usd_bytes_free(&b);
}

// The flight of flight_csv in a uSD log, cut off at the end.
static const char *write_flight(size_t cut) {
  usd_bytes_t b = {0};
  put_head(&b, 2, 1);
  usd_put(&b, 0, 2), usd_put_name(&b, "fixedFrequency"), usd_put(&b, FC_COLUMNS - 1, 2);
  for (int c = 1; c < FC_COLUMNS; c++) {
    char name[40];
    snprintf(name, sizeof name, "%s(f)", flight_csv_name[c]);
    usd_put_name(&b, name);
  }
  for (int i = 0; i < 2000; i++) {
    double v[FC_COLUMNS];
    flight_csv_values(0.01 * i, v);
    put_stamp(&b, 2, 0, (uint64_t)(10 * i));
    for (int c = 1; c < FC_COLUMNS; c++) usd_put_float(&b, (float)v[c]);
  }
  usd_put_crc(&b);
  const char *const path = scratch_file("flight.bin", (const char *)b.byte, (long)(b.n - cut));
  usd_bytes_free(&b);
  return path;
}

TEST(gap_reads_a_usd_log_as_the_csv_of_the_same_flight) {
  const columns_t columns = flight_csv_columns();
  model_t vehicle;
  gap_flight_t csv, usd, cut;
  why_t why = {""};
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  CHECK_OK(gap_read(&csv, flight_csv_file(&(flight_csv_t){.rows = 2000}, "f.csv"), &columns, &vehicle, &why));
  CHECK_OK(gap_read(&usd, write_flight(0), &columns, &vehicle, &why));
  CHECK_OK(gap_read(&cut, write_flight(1000), &columns, &vehicle, &why));
  CHECK_TEXT(why.text, "");
  CHECK(usd.n == csv.n && usd.n_note == 0);
  for (int s = 0; s < SIG_COUNT; s++) {
    CHECK((usd.v[s] == NULL) == (csv.v[s] == NULL));
    for (int i = 0; usd.v[s] && csv.v[s] && i < usd.n; i++)
      if (isfinite(csv.v[s][i]) && !CHECK_NEAR(usd.v[s][i], csv.v[s][i], 1e-5 * (1.0 + fabs(csv.v[s][i]))))
        break;
  }
  CHECK(cut.n < usd.n && cut.n > usd.n - 20 && cut.n_note == 1);
  CHECK(strstr(cut.note[0], "the file is cut off; what is before it is used") != NULL);
  gap_flight_free(&csv);
  gap_flight_free(&usd);
  gap_flight_free(&cut);
}
