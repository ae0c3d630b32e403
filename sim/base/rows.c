// rows.c - transposes numbers of eight into rows of eight, and back.
#include "base/rows.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define ROW_64 (8 * LANES)
#define ROW_32 (4 * LANES)

static inline void put_some(int from, int n, size_t bytes, char *rows, const char *const one[LANES]) {
  for (int i = from; i < n; i++)
    for (int k = 0; k < LANES; k++)
      memcpy(rows + ((size_t)i * LANES + (size_t)k) * bytes, one[k] + (size_t)i * bytes, bytes);
}
static inline void get_some(int from, int n, size_t bytes, const char *rows, char *const one[LANES]) {
  for (int i = from; i < n; i++)
    for (int k = 0; k < LANES; k++)
      memcpy(one[k] + (size_t)i * bytes, rows + ((size_t)i * LANES + (size_t)k) * bytes, bytes);
}

void rows_put_flags(int n, char *rows, const char *const one[LANES]) {
  for (int i = 0; i < n; i++)
    for (int k = 0; k < LANES; k++) {
      const int32_t all = -(int32_t)(one[k][i] != 0);
      memcpy(rows + ROW_32 * (size_t)i + 4 * (size_t)k, &all, sizeof all);
    }
}

#ifdef __x86_64__
#include <immintrin.h>

#define AVX2 static inline __attribute__((target("avx2"), always_inline))

AVX2 void turn_4(__m256d r[4]) {
  const __m256d a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
  const __m256d c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
  r[0] = _mm256_permute2f128_pd(a, c, 0x20);
  r[1] = _mm256_permute2f128_pd(b, d, 0x20);
  r[2] = _mm256_permute2f128_pd(a, c, 0x31);
  r[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

AVX2 void turn_8(__m256 r[8]) {
  __m256d pair[8];
  for (int i = 0; i < 8; i += 2) {
    pair[i / 2] = _mm256_castps_pd(_mm256_unpacklo_ps(r[i], r[i + 1]));
    pair[4 + i / 2] = _mm256_castps_pd(_mm256_unpackhi_ps(r[i], r[i + 1]));
  }
  for (int h = 0; h < 2; h++) {
    __m256d *const p = pair + 4 * h;
    const __m256d a = _mm256_unpacklo_pd(p[0], p[1]), b = _mm256_unpackhi_pd(p[0], p[1]);
    const __m256d c = _mm256_unpacklo_pd(p[2], p[3]), d = _mm256_unpackhi_pd(p[2], p[3]);
    r[2 * h] = _mm256_castpd_ps(_mm256_permute2f128_pd(a, c, 0x20));
    r[2 * h + 1] = _mm256_castpd_ps(_mm256_permute2f128_pd(b, d, 0x20));
    r[2 * h + 4] = _mm256_castpd_ps(_mm256_permute2f128_pd(a, c, 0x31));
    r[2 * h + 5] = _mm256_castpd_ps(_mm256_permute2f128_pd(b, d, 0x31));
  }
}

#define DOUBLES(at)    ((double *)(void *)(at))
#define FLOATS(at)     ((float *)(void *)(at))
#define DOUBLES_OF(at) ((const double *)(const void *)(at))
#define FLOATS_OF(at)  ((const float *)(const void *)(at))

__attribute__((target("avx2"))) void rows_put_64(int n, char *rows, const char *const one[LANES]) {
  int i = 0;
  for (; i + 4 <= n; i += 4)
    for (int half = 0; half < LANES; half += 4) {
      __m256d r[4];
      for (int k = 0; k < 4; k++) r[k] = _mm256_loadu_pd(DOUBLES_OF(one[half + k] + 8 * i));
      turn_4(r);
      for (int k = 0; k < 4; k++) _mm256_storeu_pd(DOUBLES(rows + ROW_64 * (i + k) + 8 * half), r[k]);
    }
  put_some(i, n, 8, rows, one);
}

__attribute__((target("avx2"))) void rows_get_64(int n, const char *rows, char *const one[LANES]) {
  int i = 0;
  for (; i + 4 <= n; i += 4)
    for (int half = 0; half < LANES; half += 4) {
      __m256d r[4];
      for (int k = 0; k < 4; k++) r[k] = _mm256_loadu_pd(DOUBLES_OF(rows + ROW_64 * (i + k) + 8 * half));
      turn_4(r);
      for (int k = 0; k < 4; k++) _mm256_storeu_pd(DOUBLES(one[half + k] + 8 * i), r[k]);
    }
  get_some(i, n, 8, rows, one);
}

__attribute__((target("avx2"))) void rows_put_32(int n, char *rows, const char *const one[LANES]) {
  int i = 0;
  for (; i + 8 <= n; i += 8) {
    __m256 r[8];
    for (int k = 0; k < 8; k++) r[k] = _mm256_loadu_ps(FLOATS_OF(one[k] + 4 * i));
    turn_8(r);
    for (int k = 0; k < 8; k++) _mm256_storeu_ps(FLOATS(rows + ROW_32 * (i + k)), r[k]);
  }
  put_some(i, n, 4, rows, one);
}

__attribute__((target("avx2"))) void rows_get_32(int n, const char *rows, char *const one[LANES]) {
  int i = 0;
  for (; i + 8 <= n; i += 8) {
    __m256 r[8];
    for (int k = 0; k < 8; k++) r[k] = _mm256_loadu_ps(FLOATS_OF(rows + ROW_32 * (i + k)));
    turn_8(r);
    for (int k = 0; k < 8; k++) _mm256_storeu_ps(FLOATS(one[k] + 4 * i), r[k]);
  }
  get_some(i, n, 4, rows, one);
}

__attribute__((target("avx2"))) void rows_get_flags(int n, const char *rows, char *const one[LANES]) {
  for (int i = 0; i < n; i++) {
    const unsigned set = (unsigned)_mm256_movemask_ps(_mm256_loadu_ps(FLOATS_OF(rows + ROW_32 * (size_t)i)));
    for (int k = 0; k < LANES; k++) one[k][i] = (char)(set >> k & 1);
  }
}

#else

void rows_get_flags(int n, const char *rows, char *const one[LANES]) {
  for (int i = 0; i < n; i++)
    for (int k = 0; k < LANES; k++) one[k][i] = rows[ROW_32 * i + 4 * k] != 0;
}
void rows_put_64(int n, char *rows, const char *const one[LANES]) {
  put_some(0, n, 8, rows, one);
}
void rows_get_64(int n, const char *rows, char *const one[LANES]) {
  get_some(0, n, 8, rows, one);
}
void rows_put_32(int n, char *rows, const char *const one[LANES]) {
  put_some(0, n, 4, rows, one);
}
void rows_get_32(int n, const char *rows, char *const one[LANES]) {
  get_some(0, n, 4, rows, one);
}

#endif
