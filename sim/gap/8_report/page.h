// page.h - the page's parts and pictures. Only the 8_report files and their test include it.
#ifndef SIM_GAP_8_REPORT_PAGE_H
#define SIM_GAP_8_REPORT_PAGE_H

#include "gap/8_report/report.h"
#include "gap/8_report/svg.h"

// Writes a bar in a style of page.css; share: of the room that there is, 0..1.
void page_bar(FILE *out, const char *style, double share);

// Writes the section on a named effect: numbers, pictures, rivals.
void page_finding(const finding_t *f, FILE *out);
// Writes where the residual that is left is largest; nothing if that is chance and an effect is named.
void page_unknown(const report_t *r, FILE *out);

// Draws what the effect adds over its coordinate, with its standard error and the measured points.
void picture_curve(const finding_t *f, FILE *out);
// Draws the mean residual over the coordinate, before and after; from..to is marked unless both are 0.
void picture_place(const profile_t *p, double from, double to, const char *mark, FILE *out);
// Draws one channel's residual of the held-out flights over time.
void picture_time(const report_t *r, int channel, FILE *out);
// Draws how far the held-out flight, flown again, is off the measured track on one axis.
void picture_track(const resimulation_t *a, FILE *out);

#endif
