// usd_bytes.h - writes uSD log files byte by byte, for tests: no code in common with the reader.
#ifndef TEST_RIG_USD_BYTES_H
#define TEST_RIG_USD_BYTES_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
  unsigned char *byte;
  size_t n, room;
} usd_bytes_t;

void usd_put(usd_bytes_t *b, uint64_t value, int bytes); // little-endian
void usd_put_float(usd_bytes_t *b, float value);
void usd_put_name(usd_bytes_t *b, const char *name);
void usd_put_crc(usd_bytes_t *b); // CRC-32 of all bytes before
void usd_bytes_free(usd_bytes_t *b);

#endif
