// heap.h - keeps memory that is freed after each flight for the next one. Header only.
#ifndef SIM_BASE_HEAP_H
#define SIM_BASE_HEAP_H

#include <stddef.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

// A flight's record takes 2 to 20 MB. Returning it to the system and getting it anew, page by page, costs 4 %
// of the time of flights side by side. HEAP_WITHIN is the largest mmap threshold that the library accepts;
// HEAP_KEPT is how much free memory it may keep.
#define HEAP_WITHIN (32 << 20)
#define HEAP_KEPT   (1 << 30)

// Applies to the whole program from here on.
static inline void heap_keep(void) {
#ifdef __GLIBC__
  (void)mallopt(M_MMAP_THRESHOLD, HEAP_WITHIN);
  (void)mallopt(M_TRIM_THRESHOLD, HEAP_KEPT);
#endif
}

#endif
