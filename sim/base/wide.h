// wide.h - eight numbers side by side in plain C, as two vectors of four, for inner loops over many rows. +,
// -, * and / act on all four; the results are bit for bit those of one number at a time if nothing is fused
// (-ffp-contract=off). A vector of eight would be kept in memory by gcc 12, and compared one by one, on
// processors with AVX2 but no AVX-512. Uses an extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_WIDE_H
#define SIM_BASE_WIDE_H

#include <stdint.h>
#include <string.h>

#define WIDE   8
#define HALF   4
#define HALVES (WIDE / HALF)

typedef double four_t __attribute__((vector_size(32))); // also one number per rotor
typedef int64_t four_bits_t __attribute__((vector_size(32)));

// Stands before a function. Compiles it again for AVX2 and for AVX-512; the version is selected when the
// program starts, which is too early for sanitizers. Functions that it calls must be inline (WIDE_INLINE).
// Where a b + c stands beside a b - c, gcc 12 fuses all the same: `objdump -d out/gap` must show no
// vfmaddsub.
#ifdef __has_feature // of clang
#define WIDE_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WIDE_SANITIZED 1
#else
#define WIDE_SANITIZED 0
#endif
#if defined(__x86_64__) && !WIDE_SANITIZED
#define WIDE_COPIES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDE_COPIES
#endif
#define WIDE_INLINE static inline __attribute__((always_inline))

// Macros, not functions: how four numbers are passed by value depends on the processor.
#define FOUR_LOAD(to, p)  memcpy(&(to), (p), sizeof(four_t))
#define FOUR_PUT(p, from) memcpy((p), &(from), sizeof(four_t))

#endif
