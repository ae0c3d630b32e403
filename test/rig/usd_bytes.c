// usd_bytes.c - uSD log files, byte by byte, for tests.
#include "rig/usd_bytes.h"

#include <stdlib.h>
#include <string.h>

void usd_put(usd_bytes_t *b, uint64_t value, int bytes) {
  if (b->n + 8 > b->room) {
    b->room = 2 * b->room + 4096;
    b->byte = realloc(b->byte, b->room);
    if (!b->byte) abort();
  }
  for (int i = 0; i < bytes; i++) b->byte[b->n++] = (unsigned char)(value >> (8 * i));
}

void usd_put_float(usd_bytes_t *b, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  usd_put(b, bits, 4);
}

void usd_put_name(usd_bytes_t *b, const char *name) {
  do usd_put(b, (unsigned char)*name, 1);
  while (*name++);
}

void usd_put_crc(usd_bytes_t *b) {
  uint32_t crc = 0xffffffffu;
  for (size_t i = 0; i < b->n; i++) {
    crc ^= b->byte[i];
    for (int k = 0; k < 8; k++) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  usd_put(b, ~crc, 4);
}

void usd_bytes_free(usd_bytes_t *b) {
  free(b->byte);
  *b = (usd_bytes_t){0};
}
