// svg.h - line charts as inline SVG, for a self-contained page. The styles are in page.css.
#ifndef SIM_GAP_8_REPORT_SVG_H
#define SIM_GAP_8_REPORT_SVG_H

#include <stdio.h>

typedef struct {
  FILE *out;
  double x_from, x_to, y_from, y_to; // the range of the frame
  int n_label;
} chart_t;

// Writes text with &, <, > and quotes escaped, between two pieces of HTML; control characters become `?`.
void html_text(FILE *out, const char *before, const char *text, const char *after);

// svg_frame() returns an empty frame; svg_hold() widens it to hold all finite points x[0..n-1], y[0..n-1].
chart_t svg_frame(FILE *out);
void svg_hold(chart_t *c, int n, const double *x, const double *y);

// Draws the frame with axes, ticks and labels; its y range is rounded outwards. title: for screen readers.
void svg_open(chart_t *c, const char *title, const char *x_label, const char *y_label);
void svg_close(chart_t *c);

// Each draws a layer in a style class. NaN breaks a line. label: in the legend; null: none.
void svg_line(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label);
void svg_band(chart_t *c, int n, const double *x, const double *low, const double *high, const char *style,
              const char *label);
void svg_dots(chart_t *c, int n, const double *x, const double *y, const char *style, const char *label);
// Shades the frame between two values of x.
void svg_range(chart_t *c, double from, double to, const char *style, const char *label);

#endif
