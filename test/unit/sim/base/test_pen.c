// test_pen.c - the same bytes as printf.
#include "base/number.h"
#include "base/pen.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool same(double v, int n) {
  char want[PEN_NUMBER + 1], got[PEN_NUMBER + 1];
  snprintf(want, sizeof want, "%.*f", n, v);
  got[pen_fixed_text(got, v, n)] = '\0';
  bool good = CHECK_TEXT(got, want);
  snprintf(want, sizeof want, "%.*g", n, v);
  got[pen_general_text(got, v, n)] = '\0';
  return CHECK_TEXT(got, want) && good;
}

// Ties that are exact, ties that only seem to be, the ends of what a double is, and what is none.
static const double ODD[] = {0.0,
                             -0.0,
                             0.5,
                             1.5,
                             2.5,
                             0.125,
                             0.375,
                             -0.5,
                             0.05,
                             0.15,
                             0.25,
                             1e-7,
                             5e-8,
                             4.9e-8,
                             1e22,
                             1e23,
                             123456.5,
                             9.9999995,
                             0.9995,
                             99999.5,
                             999999.5,
                             1e-5,
                             9.995e-5,
                             1e300,
                             1e-300,
                             65535.0,
                             -1e-9,
                             DBL_MAX,
                             DBL_MIN,
                             5e-324,
                             (double)INFINITY,
                             -(double)INFINITY,
                             (double)NAN};

TEST(pen_writes_the_same_bytes_as_printf) {
  for (unsigned i = 0; i < sizeof ODD / sizeof *ODD; i++)
    for (int n = 0; n <= 17; n++) {
      ROW("%g, %d", ODD[i], n);
      if (!same(ODD[i], n)) return;
    }
  splitmix_t state = {7};
  for (int i = 0; i < 100000; i++) {
    const uint64_t bits = splitmix_bits(&state);
    double any;
    memcpy(&any, &bits, sizeof any);
    const double usual = ((double)(bits >> 11) / 9007199254740992.0 - 0.5) * pow(10.0, (double)(bits % 7));
    const double short_one = round(usual * 1e4) / 1e4, tie = round(usual * 128.0) / 128.0;
    if (isnan(any)) continue;
    ROW("%.17g and %.17g", any, usual);
    const int n = (int)(bits >> 3 & 7) + 1;
    const double near_ten = pow(10.0, (double)(bits % 19) - 6.0), single = (double)(float)usual;
    const double beside = nextafter(near_ten, bits & 32 ? HUGE_VAL : 0.0);
    if (!same(any, n) || !same(usual, n) || !same(short_one, n) || !same(tie, n)) return;
    if (!same(single, n) || !same(single, 9) || !same(near_ten, n) || !same(beside, n + 4)) return;
  }
}

TEST(pen_writes_rows_longer_than_its_own_room) {
  FILE *const file = tmpfile();
  if (!CHECK(file != NULL)) return;
  static char got[20000], want[20000];
  size_t used = 0;
  pen_t pen;
  pen_begin(&pen, file);
  for (int i = 0; i < 1500; i++) {
    pen_fixed(&pen, i / 3.0, 3);
    pen_char(&pen, i % 10 == 9 ? '\n' : ',');
    used += (size_t)snprintf(want + used, sizeof want - used, "%.3f%c", i / 3.0, i % 10 == 9 ? '\n' : ',');
  }
  pen_flush(&pen);
  rewind(file);
  CHECK(fread(got, 1, sizeof got, file) == used && used > 2 * sizeof pen.text);
  CHECK(memcmp(got, want, used) == 0);
  fclose(file);
}

// --- and back ---------------------------------------------------------------------------------------------

static const char *const NUMBER[] = {"0",
                                     "-0",
                                     "+1.5",
                                     "+.5",
                                     ".5",
                                     "5.",
                                     "-.25e+3",
                                     "1e22",
                                     "1e23",
                                     "1e308",
                                     "1e309",
                                     "-1e400",
                                     "4.9e-324",
                                     "2e-324",
                                     "1e-400",
                                     "00012.50",
                                     "1E5",
                                     "1e05",
                                     "0.1",
                                     "2.2250738585072011e-308",
                                     "9007199254740993",
                                     "123456789012345678901234567890.5"};
static const char *const NONE[] = {"",    "+",   "-",   ".",     "e5",    "1e",
                                   "+-1", "-+1", "++1", "1.5.2", "1e5.0", "--1"};

static bool as_strtod(const char *text) {
  const double want = strtod(text, NULL);
  double x;
  ROW("%s", text);
  return CHECK(number_parse(text, &x) && memcmp(&x, &want, sizeof x) == 0);
}

TEST(number_has_the_same_bits_as_strtod) {
  for (unsigned i = 0; i < sizeof NUMBER / sizeof *NUMBER; i++) as_strtod(NUMBER[i]);
  for (unsigned i = 0; i < sizeof NONE / sizeof *NONE; i++) {
    double x;
    ROW("`%s`", NONE[i]);
    CHECK(!number_parse(NONE[i], &x));
  }
  splitmix_t state = {11};
  for (int i = 0; i < 100000; i++) {
    const uint64_t bits = splitmix_bits(&state);
    double any;
    char line[40];
    memcpy(&any, &bits, sizeof any);
    if (!isfinite(any)) continue;
    snprintf(line, sizeof line, "%.*g", (int)(bits % 20) + 1, any);
    if (!as_strtod(line)) return;
  }
}
