// pen.h - rows of numbers into a file, the same bytes as printf writes in the "C" locale, several times as
// fast (std::to_chars behind a C header).
#ifndef SIM_BASE_PEN_H
#define SIM_BASE_PEN_H

#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PEN_NUMBER 360 // bytes that a number needs at most: 309 digits, a point, 40 places, a sign
#define PEN_PLACES 40  // at most, and digits

// As "%.{places}f", without a 0 at the end; returns how many bytes. places: 0..PEN_PLACES; of what is beyond
// these the nearest.
int pen_fixed_text(char text[PEN_NUMBER], double value, int places);
// As "%.{digits}g".
int pen_general_text(char text[PEN_NUMBER], double value, int digits);

// What is written goes to the file in pieces, the rest with pen_flush. The file knows if that failed, and for
// what reason when it is closed: a piece is smaller than the stream's own room, where it stays then.
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
