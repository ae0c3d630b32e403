// text.h - text for messages, truncated to its buffer.
#ifndef SIM_BASE_TEXT_H
#define SIM_BASE_TEXT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Appends to the text.
void text_add(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

#ifdef __cplusplus
}
#endif

// Writes line n of a list of empty lines and increments n, while there is room.
#define text_line(list, n, ...)                                                                              \
  ((n) < (int)(sizeof(list) / sizeof *(list)) ? text_add((list)[(n)++], sizeof *(list), __VA_ARGS__)         \
                                              : (void)0)

// The separator between a number and its unit: empty if there is no unit.
static inline const char *text_gap(const char *unit) {
  return unit[0] ? " " : "";
}

#endif
