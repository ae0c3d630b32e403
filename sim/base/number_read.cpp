// number_read.cpp - fast conversion of text to a number.
#include "base/number.h"

#include <charconv>

bool number_read(const char *text, size_t size, double *value) {
  const auto read = std::from_chars(text, text + size, *value);
  return read.ec == std::errc() && read.ptr == text + size;
}
