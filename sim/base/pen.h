// pen.h - writes rows of numbers to a file, with the same bytes as printf in the "C" locale but several times
// as fast (std::to_chars behind a C header).
#ifndef SIM_BASE_PEN_H
#define SIM_BASE_PEN_H

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PEN_NUMBER 360 // most bytes of a number: 309 digits, a point, 40 places, a sign
#define PEN_PLACES 40  // most places, and most digits

// Writes as "%.{places}f" does, without a terminating zero, and returns the number of bytes. places is
// limited to 0..PEN_PLACES.
int pen_fixed_text(char text[PEN_NUMBER], double value, int places);
// The same as "%.{digits}g".
int pen_general_text(char text[PEN_NUMBER], double value, int digits);

// Text goes to the file in pieces; pen_flush writes the rest. Errors remain in the stream (ferror), and
// closing it still gives the reason: a piece is smaller than the stream's buffer, where it then stays.
typedef struct {
  FILE *file;
  size_t used;
  char text[2048];
} pen_t;

void pen_begin(pen_t *pen, FILE *file);
void pen_fixed(pen_t *pen, double value, int places);
void pen_general(pen_t *pen, double value, int digits);
void pen_char(pen_t *pen, char c);
void pen_flush(pen_t *pen);

#ifdef __cplusplus
}
#endif

#endif
