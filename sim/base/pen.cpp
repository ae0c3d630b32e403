// pen.cpp - rows of numbers into a file.
#include "base/pen.h"

#include <algorithm>
#include <charconv>

static int written(char text[PEN_NUMBER], double value, std::chars_format format, int precision) {
  const int n = std::clamp(precision, 0, PEN_PLACES);
  return static_cast<int>(std::to_chars(text, text + PEN_NUMBER, value, format, n).ptr - text);
}

int pen_fixed_text(char text[PEN_NUMBER], double value, int places) {
  return written(text, value, std::chars_format::fixed, places);
}

int pen_general_text(char text[PEN_NUMBER], double value, int digits) {
  return written(text, value, std::chars_format::general, digits);
}

void pen_begin(pen_t *pen, FILE *file) {
  pen->file = file;
  pen->used = 0;
}

void pen_flush(pen_t *pen) {
  fwrite(pen->text, 1, pen->used, pen->file);
  pen->used = 0;
}

// Where so many bytes can be put.
static char *room(pen_t *pen, size_t bytes) {
  if (pen->used + bytes > sizeof pen->text) pen_flush(pen);
  return pen->text + pen->used;
}

void pen_fixed(pen_t *pen, double value, int places) {
  pen->used += static_cast<size_t>(pen_fixed_text(room(pen, PEN_NUMBER), value, places));
}

void pen_general(pen_t *pen, double value, int digits) {
  pen->used += static_cast<size_t>(pen_general_text(room(pen, PEN_NUMBER), value, digits));
}

void pen_char(pen_t *pen, char c) {
  *room(pen, 1) = c;
  pen->used++;
}
