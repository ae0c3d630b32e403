// page.h - the page's parts and pictures. Only the 8_report files and their test include it.
#ifndef SIM_GAP_8_REPORT_PAGE_H
#define SIM_GAP_8_REPORT_PAGE_H

#include "gap/8_report/report.h"
#include "gap/8_report/svg.h"

// A bar of a style (page.css), so much of the room that there is.
void page_bar(FILE *out, const char *style, double share);

// A named effect: numbers, pictures, rivals.
void page_finding(const finding_t *f, FILE *out);
// What is left where it is largest; nothing if that is chance and something is named.
void page_unknown(const report_t *r, FILE *out);

// What the effect adds over its coordinate, with its band, and what was measured of it.
void picture_curve(const finding_t *f, FILE *out);
// The mean residual over the coordinate, before and after; from..to is marked unless both are 0.
void picture_place(const profile_t *p, double from, double to, const char *mark, FILE *out);
// The residual of the held-out flights over time, one channel.
void picture_time(const report_t *r, int channel, FILE *out);
// The held-out track, measured and flown again.
void picture_track(const resimulation_t *a, FILE *out);

#endif
