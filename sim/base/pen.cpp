// pen.cpp - writes rows of numbers to a file.
#include "base/pen.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

static int written(char text[PEN_NUMBER], double value, std::chars_format format, int precision) {
  const int n = std::clamp(precision, 0, PEN_PLACES);
  return static_cast<int>(std::to_chars(text, text + PEN_NUMBER, value, format, n).ptr - text);
}

// Nearly every number of a log has few digits. One rounded product in double then gives all of them, unless
// its rounding error could change the result; std::to_chars handles those cases.

constexpr int DIGITS = 12; // at most: whole numbers below 2^40
constexpr double TEN[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15}; // exact

// Rounds value * power, >= 0, to the nearest whole number. False if it is too near to a tie, or too large.
// Below 2^40 the product's error is at most 2^-13.
static bool nearest(double value, double power, uint64_t &whole) {
  const double product = value * power;
  if (!(product < 0x1p40)) return false; // or NaN
  whole = static_cast<uint64_t>(product);
  const double rest = product - static_cast<double>(whole);
  whole += rest > 0.5;
  return std::fabs(rest - 0.5) > 0x1p-10;
}

static char *put_whole(char *at, uint64_t whole) {
  return std::to_chars(at, at + DIGITS + 1, whole).ptr;
}

static char *put_sign(char *at, double value) {
  *at = '-';
  return at + std::signbit(value);
}

// The number of bytes written; 0 if this fast way cannot do it.
static int fixed_shortly(char *text, double value, int places) {
  uint64_t whole;
  if (places < 0 || places > DIGITS || !nearest(std::fabs(value), TEN[places], whole)) return 0;
  char digit[DIGITS + 1], *at = put_sign(text, value);
  const int n = static_cast<int>(put_whole(digit, whole) - digit), before = std::max(n - places, 0);
  if (before == 0) *at++ = '0';
  at = std::copy_n(digit, before, at);
  if (places > 0) *at++ = '.';
  at = std::fill_n(at, std::max(places - n, 0), '0');
  at = std::copy_n(digit + before, n - before, at);
  return static_cast<int>(at - text);
}

// The power with 10^power <= value < 10^(power + 1), up to rounding of the product.
static int power_of(double value) {
  int power = 0;
  while (value >= TEN[power + 1]) power++;
  if (power > 0) return power;
  while (value * TEN[-power] < 1.0) power--;
  return power;
}

static int general_shortly(char *text, double value, int digits) {
  const double size = std::fabs(value);
  if (digits < 1 || digits > DIGITS || !(size < TEN[digits])) return 0;
  uint64_t whole = static_cast<uint64_t>(size);
  char *at = put_sign(text, value);
  if (static_cast<double>(whole) == size) return static_cast<int>(put_whole(at, whole) - text);
  if (size < 1e-3) return 0; // smaller ones soon need an exponent
  const int power = power_of(size);
  if (!nearest(size, TEN[digits - 1 - power], whole)) return 0;
  // At either end of the range, the exponent may be off by one.
  if (static_cast<double>(whole) <= TEN[digits - 1] || static_cast<double>(whole) >= TEN[digits]) return 0;
  char digit[DIGITS + 1];
  int n = static_cast<int>(put_whole(digit, whole) - digit);
  const int before = std::max(power + 1, 0);
  while (n > before && digit[n - 1] == '0') n--;
  if (before == 0) *at++ = '0';
  at = std::copy_n(digit, before, at);
  if (n > before) *at++ = '.';
  at = std::fill_n(at, std::max(-power - 1, 0), '0');
  at = std::copy_n(digit + before, n - before, at);
  return static_cast<int>(at - text);
}

int pen_fixed_text(char text[PEN_NUMBER], double value, int places) {
  const int done = fixed_shortly(text, value, places);
  return done ? done : written(text, value, std::chars_format::fixed, places);
}

int pen_general_text(char text[PEN_NUMBER], double value, int digits) {
  const int done = general_shortly(text, value, digits);
  return done ? done : written(text, value, std::chars_format::general, digits);
}

void pen_begin(pen_t *pen, FILE *file) {
  pen->file = file;
  pen->used = 0;
}

void pen_flush(pen_t *pen) {
  fwrite(pen->text, 1, pen->used, pen->file);
  pen->used = 0;
}

// Returns where that many bytes can be written.
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
