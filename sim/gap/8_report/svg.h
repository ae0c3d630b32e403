// svg.h - line charts as inline SVG, for a page that needs nothing else. Styles are the page's
// (page.c).
#ifndef SIM_GAP_8_REPORT_SVG_H
#define SIM_GAP_8_REPORT_SVG_H

#include <stdio.h>

typedef struct {
  FILE *out;
  double x_from, x_to, y_from, y_to; // what the frame spans
  int n_label;
} chart_t;

// Writes text with &, <, > and quotes escaped, between two pieces of HTML; what is not text becomes `?`.
void html_text(FILE *out, const char *before, const char *text, const char *after);

// Makes an empty frame hold all finite values of y[0..n-1] (and x); start with svg_frame().
chart_t svg_frame(FILE *out);
void svg_hold(chart_t *c, int n, const double *x, const double *y);

// The frame with axes, ticks and labels; what it holds is rounded outwards. title: read by those who do not
// see it.
void svg_open(chart_t *c, const char *title, const char *x_label, const char *y_label);
void svg_close(chart_t *c);

// Layers, each with a style class. NaN breaks a line. label: of the legend; null: none.
void svg_line(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label);
void svg_band(chart_t *c, int n, const double *x, const double *low, const double *high, const char *style,
              const char *label);
void svg_dots(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label);
// What lies between two values of x.
void svg_range(chart_t *c, double from, double to, const char *style, const char *label);

#endif
