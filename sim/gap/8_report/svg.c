// svg.c - line charts as inline SVG.
#include "gap/8_report/svg.h"

#include <math.h>
#include <stdbool.h>

#define WIDE   640.0 // even on a page 420 px wide, letters of 15 can be read
#define HIGH   280.0
#define LEFT   74.0
#define RIGHT  12.0
#define TOP    34.0
#define BOTTOM 50.0
#define POINTS 900 // of a line; a longer one is drawn by the minimum and maximum of each part
#define TICKS  6

void html_text(FILE *out, const char *before, const char *text, const char *after) {
  fputs(before, out);
  for (const unsigned char *c = (const unsigned char *)text; *c; c++) switch (*c) {
    case '&': fputs("&amp;", out); break;
    case '<': fputs("&lt;", out); break;
    case '>': fputs("&gt;", out); break;
    case '"': fputs("&quot;", out); break;
    case '\'': fputs("&#39;", out); break;
    default: fputc(*c < 0x20 || *c == 0x7f ? '?' : *c, out); // the page is UTF-8
    }
  fputs(after, out);
}

chart_t svg_frame(FILE *out) {
  return (chart_t){out, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, 0};
}

void svg_hold(chart_t *c, int n, const double *x, const double *y) {
  for (int i = 0; i < n; i++) {
    if (!isfinite(x[i]) || !isfinite(y[i])) continue;
    c->x_from = fmin(c->x_from, x[i]), c->x_to = fmax(c->x_to, x[i]);
    c->y_from = fmin(c->y_from, y[i]), c->y_to = fmax(c->y_to, y[i]);
  }
}

// Returns the distance between ticks: 1, 2 or 5 times a power of ten.
static double tick_of(double span) {
  const double raw = span / TICKS, power = pow(10.0, floor(log10(raw)));
  const double share = raw / power;
  return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

static double px(const chart_t *c, double x) {
  return LEFT + (x - c->x_from) / (c->x_to - c->x_from) * (WIDE - LEFT - RIGHT);
}

static double py(const chart_t *c, double y) {
  const double at = fmin(fmax(y, c->y_from), c->y_to);
  return HIGH - BOTTOM - (at - c->y_from) / (c->y_to - c->y_from) * (HIGH - TOP - BOTTOM);
}

static void round_outwards(double *from, double *to, bool whole) {
  if (!(*to >= *from) || !isfinite(*from) || !isfinite(*to)) *from = 0.0, *to = 1.0;
  if (!(*to - *from > 1e-12 * (1.0 + fabs(*to)))) *from -= 0.5, *to += 0.5;
  const double tick = tick_of(*to - *from);
  if (!whole) return;
  *from = tick * floor(*from / tick), *to = tick * ceil(*to / tick);
}

static void ticks(chart_t *c) {
  const double x_tick = tick_of(c->x_to - c->x_from), y_tick = tick_of(c->y_to - c->y_from);
  for (double k = ceil(c->x_from / x_tick - 1e-9); k * x_tick <= c->x_to + 1e-9 * x_tick; k++)
    fprintf(
        c->out,
        "<line class=grid x1=%.1f y1=%g x2=%.1f y2=%g /><text x=%.1f y=%g text-anchor=middle>%.4g</text>\n",
        px(c, k * x_tick), TOP, px(c, k * x_tick), HIGH - BOTTOM, px(c, k * x_tick), HIGH - BOTTOM + 17.0,
        k * x_tick + 0.0);
  for (double k = ceil(c->y_from / y_tick - 1e-9); k * y_tick <= c->y_to + 1e-9 * y_tick; k++)
    fprintf(c->out,
            "<line class=%s x1=%g y1=%.1f x2=%g y2=%.1f /><text x=%g y=%.1f text-anchor=end>%.4g</text>\n",
            k == 0.0 ? "zero" : "grid", LEFT, py(c, k * y_tick), WIDE - RIGHT, py(c, k * y_tick), LEFT - 7.0,
            py(c, k * y_tick) + 4.0, k * y_tick + 0.0);
}

void svg_open(chart_t *c, const char *title, const char *x_label, const char *y_label) {
  round_outwards(&c->x_from, &c->x_to, false);
  round_outwards(&c->y_from, &c->y_to, true);
  fprintf(c->out, "<svg viewBox=\"0 0 %g %g\" role=img><title>", WIDE, HIGH);
  html_text(c->out, "", title, "</title>\n");
  ticks(c);
  fprintf(c->out, "<text class=axis x=%g y=%g text-anchor=middle>", 0.5 * (LEFT + WIDE - RIGHT), HIGH - 8.0);
  html_text(c->out, "", x_label, "</text>");
  fprintf(c->out, "<text class=axis transform=\"translate(14 %g) rotate(-90)\" text-anchor=middle>",
          0.5 * (TOP + HIGH - BOTTOM));
  html_text(c->out, "", y_label, "</text>\n");
}

void svg_close(chart_t *c) {
  fputs("</svg>\n", c->out);
}

// Draws a sample of the style and its label above the frame, left to right.
static void legend(chart_t *c, const char *style, const char *label, const char *sample) {
  if (!label) return;
  const double x = LEFT + 4.0 + 165.0 * c->n_label++;
  if (sample[0] == 'l')
    fprintf(c->out, "<path class=\"%s\" d=\"M%g 16h22\" />", style, x);
  else if (sample[0] == 'd')
    fprintf(c->out, "<circle class=\"%s\" cx=%g cy=16 r=3.4 />", style, x + 11.0);
  else
    fprintf(c->out, "<rect class=\"%s\" x=%g y=10 width=22 height=12 />", style, x);
  fprintf(c->out, "<text x=%g y=20>", x + 28.0);
  html_text(c->out, "", label, "</text>\n");
}

static void point(const chart_t *c, bool *pen, double x, double y) {
  const bool there = isfinite(x) && isfinite(y);
  if (there) fprintf(c->out, "%c%.1f %.1f", *pen ? 'L' : 'M', px(c, x), py(c, y));
  *pen = there;
}

void svg_line(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label) {
  const int part = n > POINTS ? 2 * n / POINTS + 1 : 1;
  bool pen = false;
  fprintf(c->out, "<path class=\"%s\" d=\"", style);
  for (int i = 0; i < n; i += part) {
    int low = i, high = i;
    for (int k = i; k < n && k < i + part; k++) {
      if (isfinite(y[low]) && !(y[k] >= y[low])) low = k; // a gap stays the least, so that it breaks the line
      if (!isfinite(y[high]) || y[k] > y[high]) high = k;
    }
    point(c, &pen, x[low < high ? low : high], y[low < high ? low : high]);
    if (low != high) point(c, &pen, x[low < high ? high : low], y[low < high ? high : low]);
  }
  fputs("\" />\n", c->out);
  legend(c, style, label, "line");
}

void svg_band(chart_t *c, int n, const double *x, const double *low, const double *high, const char *style,
              const char *label) {
  bool pen = false;
  fprintf(c->out, "<path class=\"%s\" d=\"", style);
  for (int i = 0; i < n; i++) point(c, &pen, x[i], low[i]);
  for (int i = n - 1; i >= 0; i--) point(c, &pen, x[i], high[i]);
  fputs("Z\" />\n", c->out);
  legend(c, style, label, "band");
}

void svg_dots(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label) {
  for (int i = 0; i < n; i++)
    if (isfinite(x[i]) && isfinite(y[i]))
      fprintf(c->out, "<circle class=\"%s\" cx=%.1f cy=%.1f r=3.4 />", style, px(c, x[i]), py(c, y[i]));
  fputc('\n', c->out);
  legend(c, style, label, "dot");
}

void svg_range(chart_t *c, double from, double to, const char *style, const char *label) {
  const double left = px(c, fmax(from, c->x_from)), right = px(c, fmin(to, c->x_to));
  if (right >= left)
    fprintf(c->out, "<rect class=\"%s\" x=%.1f y=%g width=%.1f height=%g />\n", style, left, TOP,
            fmax(right - left, 1.0), HIGH - TOP - BOTTOM);
  legend(c, style, label, "range");
}
