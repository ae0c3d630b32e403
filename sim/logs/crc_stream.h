// crc_stream.h - little-endian numbers from a stream that ends with the CRC-32 of all before (zlib's CRC).
#ifndef SIM_LOGS_CRC_STREAM_H
#define SIM_LOGS_CRC_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define CRC_STREAM_BLOCK 65536

typedef struct {
  FILE *stream;
  unsigned char block[CRC_STREAM_BLOCK];
  size_t at, end;    // range in `block` that is read but not taken
  uint64_t taken;    // bytes since the start
  unsigned long crc; // of the bytes before the block's start
} crc_stream_t;

void crc_stream_init(crc_stream_t *s, FILE *stream);

// True if n more bytes come before the last four. n must be small against the block.
bool crc_stream_have(crc_stream_t *s, size_t n);

// The next 1..8 bytes as a number; crc_stream_have said that they are there.
uint64_t crc_stream_take(crc_stream_t *s, int bytes);

// The same without taking them.
uint64_t crc_stream_peek(const crc_stream_t *s, int bytes);

// The same as a value of a type in Python's letters: u8 i8 u16 i16 u32 i32 float half.
#define CRC_STREAM_TYPES "BbHhIife"
int crc_stream_bytes(char type);
double crc_stream_value(crc_stream_t *s, char type);

typedef enum { CRC_GOOD, CRC_WRONG, CRC_CUT_OFF } crc_end_t;

// After the last record: whether the bytes left are the CRC of all before. CRC_CUT_OFF: they are not four.
crc_end_t crc_stream_end(const crc_stream_t *s);

#endif
