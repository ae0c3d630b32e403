// crc_stream.c - little-endian numbers from a stream that ends with the CRC-32 of all before.
#include "logs/crc_stream.h"

#include <math.h>
#include <string.h>
#include <zlib.h>

#define CRC_BYTES 4

void crc_stream_init(crc_stream_t *s, FILE *stream) {
  s->stream = stream;
  s->at = s->end = 0;
  s->taken = 0;
  s->crc = crc32(0, NULL, 0);
}

bool crc_stream_have(crc_stream_t *s, size_t n) {
  if (s->end - s->at >= n + CRC_BYTES) return true;
  s->crc = crc32(s->crc, s->block, (uInt)s->at);
  memmove(s->block, s->block + s->at, s->end - s->at);
  s->end -= s->at;
  s->at = 0;
  while (s->end < n + CRC_BYTES) {
    const size_t got = fread(s->block + s->end, 1, sizeof s->block - s->end, s->stream);
    if (got == 0) return false;
    s->end += got;
  }
  return true;
}

uint64_t crc_stream_peek(const crc_stream_t *s, int bytes) {
  uint64_t value = 0;
  for (int i = 0; i < bytes; i++) value |= (uint64_t)s->block[s->at + (size_t)i] << (8 * i);
  return value;
}

uint64_t crc_stream_take(crc_stream_t *s, int bytes) {
  const uint64_t value = crc_stream_peek(s, bytes);
  s->at += (size_t)bytes;
  s->taken += (uint64_t)bytes;
  return value;
}

int crc_stream_bytes(char type) {
  return strchr("Bb", type) ? 1 : strchr("Hhe", type) ? 2 : 4;
}

static double half(unsigned bits) {
  const int exponent = (int)(bits >> 10 & 31), fraction = (int)(bits & 1023);
  const double size = exponent == 0    ? ldexp(fraction, -24)
                      : exponent == 31 ? (fraction ? (double)NAN : HUGE_VAL)
                                       : ldexp(1024 + fraction, exponent - 25);
  return bits & 0x8000 ? -size : size;
}

double crc_stream_value(crc_stream_t *s, char type) {
  const uint32_t bits = (uint32_t)crc_stream_take(s, crc_stream_bytes(type));
  float single;
  switch (type) {
  case 'b': return (int8_t)bits;
  case 'h': return (int16_t)bits;
  case 'i': return (int32_t)bits;
  case 'e': return half(bits);
  case 'f': memcpy(&single, &bits, sizeof single); return (double)single;
  default: return bits;
  }
}

crc_end_t crc_stream_end(const crc_stream_t *s) {
  if (s->end - s->at != CRC_BYTES) return CRC_CUT_OFF;
  return crc32(s->crc, s->block, (uInt)s->at) == crc_stream_peek(s, CRC_BYTES) ? CRC_GOOD : CRC_WRONG;
}
