// text.h - words for people, cut where they have no room.
#ifndef SIM_BASE_TEXT_H
#define SIM_BASE_TEXT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Writes behind what stands in the text.
void text_add(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

#ifdef __cplusplus
}
#endif

// Writes line number n of a list of empty ones, and counts it, while there is room.
#define text_line(list, n, ...)                                                                              \
  ((n) < (int)(sizeof(list) / sizeof *(list)) ? text_add((list)[(n)++], sizeof *(list), __VA_ARGS__)         \
                                              : (void)0)

// What stands between a number and its unit: nothing where it has none.
static inline const char *text_gap(const char *unit) {
  return unit[0] ? " " : "";
}

#endif
