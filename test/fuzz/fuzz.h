// fuzz.h - stage 1 of the workflow on any bytes: what both fuzzers do.
#ifndef TEST_FUZZ_H
#define TEST_FUZZ_H

#include <stddef.h>
#include <stdint.h>

// Reads a log through gap_read and aborts if what comes out breaks its promises. What the log is, the first
// byte of data says: the rest of data; a good log with the rest of data behind it; or a good log in which
// every three bytes of the rest (place, place, value) change one.
void fuzz_log(const uint8_t *good, size_t good_size, const uint8_t *data, size_t size);

#endif
