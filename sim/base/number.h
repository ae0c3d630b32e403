// number.h - conversion between numbers and text, with a decimal point in every locale.
#ifndef SIM_BASE_NUMBER_H
#define SIM_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// True if all of `text` is a decimal number (`1`, `-0.5`, `2e-3`); *value receives it, infinite if it is too
// large. False for an empty text, blanks, hexadecimal numbers and the words for infinity and not-a-number.
bool number_parse(const char *text, double *value);

// Copies text for a message: unprintable characters become `?`, and long text is truncated.
#define NUMBER_SHOWN 40
const char *number_shown(const char *text, char shown[NUMBER_SHOWN]);

// Several times as fast as strtod; where it returns true, the value has the same bits. False also for some
// texts that strtod accepts: a leading plus, and numbers out of range.
bool number_read(const char *text, size_t size, double *value);

#ifdef __cplusplus
}
#endif

#endif
