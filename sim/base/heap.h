// heap.h - memory that flight after flight frees and asks for again. Header only.
#ifndef SIM_BASE_HEAP_H
#define SIM_BASE_HEAP_H

#include <stddef.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

// A flight's record is 2 to 20 MB. Given back to the system and taken anew, page by page, it costs 4 % of the
// flights that are flown side by side. 32 MB is the most that the library takes for the first; the second is
// what it may hold back.
#define HEAP_WITHIN (32 << 20)
#define HEAP_KEPT   (1 << 30)

// Of this program, from here on.
static inline void heap_keep(void) {
#ifdef __GLIBC__
  (void)mallopt(M_MMAP_THRESHOLD, HEAP_WITHIN);
  (void)mallopt(M_TRIM_THRESHOLD, HEAP_KEPT);
#endif
}

#endif
