// test_gap_svg.c - the report's line charts.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "gap/8_report/svg.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

enum { LINE = 2700 }; // points: seven of them are drawn as two

// Counts the pieces of a line of LINE points that has no value at one of them.
static int pieces(int gap) {
  static double x[LINE], y[LINE];
  char *text = NULL;
  size_t size = 0;
  FILE *const out = open_memstream(&text, &size);
  if (!CHECK(out)) return 0;
  for (int i = 0; i < LINE; i++) x[i] = i, y[i] = i == gap ? (double)NAN : sin(i);
  chart_t c = svg_frame(out);
  svg_hold(&c, LINE, x, y);
  svg_line(&c, LINE, x, y, "before", NULL);
  fclose(out);
  int n = 0;
  for (const char *p = text; *p; p++) n += *p == 'M';
  free(text);
  return n;
}

TEST(gap_charts_break_a_long_line_wherever_it_has_no_value) {
  static const struct {
    int gap, pieces;
  } row[] = {{-1, 1}, {1400, 2}, {1401, 2}, {1403, 2}, {1406, 2}, {1407, 2}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("no value at %d", row[i].gap);
    CHECK(pieces(row[i].gap) == row[i].pieces);
  }
}
