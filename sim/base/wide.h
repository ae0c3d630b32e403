// wide.h - eight numbers side by side in plain C, as two times four: inner loops over many rows. +, -, * and
// / act on all four; the results are those of one at a time, to the bit, where nothing is fused
// (-ffp-contract=off). Eight in one gcc 12 would keep in memory, and compare one by one, where there is AVX2
// and no AVX-512. An extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_WIDE_H
#define SIM_BASE_WIDE_H

#include <stdint.h>
#include <string.h>

#define WIDE   8
#define HALF   4
#define HALVES (WIDE / HALF)

typedef double four_t __attribute__((vector_size(32))); // also of every rotor one
typedef int64_t four_bits_t __attribute__((vector_size(32)));

// Before a function: it is compiled once more for AVX2 and for AVX-512, and which one is called is found out
// when the program starts: too early for a sanitizer. What it calls has to be inline (WIDE_INLINE). Where
// a b + c stands beside a b - c, gcc 12 fuses all the same: `objdump -d out/gap` is to show no vfmaddsub.
#ifdef __has_feature // clang's
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

// By name and not by value: how four numbers are handed to a function differs from processor to processor.
#define FOUR_LOAD(to, p)  memcpy(&(to), (p), sizeof(four_t))
#define FOUR_PUT(p, from) memcpy((p), &(from), sizeof(four_t))

#endif
