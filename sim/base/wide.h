// wide.h - eight numbers at a time in plain C, by the widest registers that the processor has: inner loops
// over many rows. +, -, * and / act on all eight; the results are those of one at a time, to the bit, where
// nothing is fused (-ffp-contract=off). An extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_WIDE_H
#define SIM_BASE_WIDE_H

#include <stdint.h>
#include <string.h>

#define WIDE 8

typedef double wide_t __attribute__((vector_size(64)));
typedef double four_t __attribute__((vector_size(32))); // of every rotor one
typedef int64_t four_bits_t __attribute__((vector_size(32)));
typedef int64_t wide_bits_t __attribute__((vector_size(64)));

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

// By name and not by value: how a wide number is handed to a function differs from processor to processor.
#define WIDE_LOAD(to, p)  memcpy(&(to), (p), sizeof(wide_t))
#define WIDE_PUT(p, from) memcpy((p), &(from), sizeof(wide_t))

#endif
