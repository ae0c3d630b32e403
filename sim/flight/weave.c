// weave.c - copies the numbers of a block of one flight into a lane and back.
#include "flight/weave.h"

#include "base/rows.h"
#include "flight/lanes_blocks.h"
#include <pthread.h>
#include <string.h>

#define NUMBERS 2048 // of a block, at most

static weave_t blocks[LANES_BLOCK_COUNT];
static bool good;

static const size_t width[] = {[LANE_FLAG] = 1, [LANE_I8] = 1, [LANE_U8] = 1, [LANE_I16] = 2,
                               [LANE_U16] = 2,  [LANE_32] = 4, [LANE_64] = 8};

static size_t lane_bytes(lane_field_kind_t kind) {
  return kind == LANE_64 ? 8 : 4;
}

static bool goes_on(const weave_run_t *r, const lane_field_t *one, const lane_field_t *eight) {
  return r->kind == one->kind && one->at == r->one + (size_t)r->n * width[r->kind] &&
         eight->at == r->eight + (size_t)r->n * LANES * lane_bytes(r->kind);
}

static bool collect(int block, size_t size) {
  static lane_field_t one[NUMBERS], eight[NUMBERS];
  weave_t *const b = &blocks[block];
  size_t size_of_one, size_of_eight;
  b->block = block;
  const int n = lanes_fields_of_one(block, one, NUMBERS, &size_of_one);
  if (n < 0 || n >= NUMBERS || size_of_one != size) return false;
  if (lanes_fields_of_eight(block, eight, NUMBERS, &size_of_eight) != n) return false;
  for (int i = 0; i < n; i++) {
    if (one[i].kind != eight[i].kind) return false;
    if (b->n > 0 && goes_on(&b->run[b->n - 1], &one[i], &eight[i])) {
      b->run[b->n - 1].n++;
      continue;
    }
    if (b->n == WEAVE_RUNS) return false;
    b->run[b->n++] = (weave_run_t){one[i].at, eight[i].at, 1, one[i].kind};
  }
  return true;
}

#define SIZE(name, type, where) [LANES_##name] = sizeof(type),

static void collect_all(void) {
  static const size_t size[] = {LANES_BLOCKS(SIZE)};
  good = lane_possible();
  for (int i = 0; good && i < LANES_BLOCK_COUNT; i++) good = collect(i, size[i]);
}

const weave_t *weave_block(int block) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  (void)pthread_once(&once, collect_all);
  return good ? &blocks[block] : NULL;
}

// In lanes integers of fewer bits are widened to 32, and a flag is all bits or none.
static int32_t widened(lane_field_kind_t kind, const char *one) {
  switch (kind) {
  case LANE_FLAG: return -*(const uint8_t *)one;
  case LANE_I8: return *(const int8_t *)one;
  case LANE_U8: return *(const uint8_t *)one;
  case LANE_I16: return *(const int16_t *)(const void *)one;
  default: return *(const uint16_t *)(const void *)one;
  }
}

static void narrow(lane_field_kind_t kind, int32_t x, char *one) {
  const uint8_t byte = kind == LANE_FLAG ? x != 0 : (uint8_t)x;
  const uint16_t two = (uint16_t)x;
  if (width[kind] == 1)
    memcpy(one, &byte, sizeof byte);
  else
    memcpy(one, &two, sizeof two);
}

// Address of number i of a run, in the struct of one and in the lane.
#define ONE(i, bytes)  (one + (size_t)(i) * (bytes))
#define LANE(i, bytes) (eight + (size_t)(i) * (bytes)*LANES)

static void put_run(const weave_run_t *r, char *restrict eight, const char *restrict one) {
  const size_t wide = width[r->kind];
  if (r->kind == LANE_64) {
    for (int i = 0; i < r->n; i++) memcpy(LANE(i, 8), ONE(i, 8), 8);
  } else if (r->kind == LANE_32) {
    for (int i = 0; i < r->n; i++) memcpy(LANE(i, 4), ONE(i, 4), 4);
  } else {
    for (int i = 0; i < r->n; i++) {
      const int32_t x = widened(r->kind, ONE(i, wide));
      memcpy(LANE(i, 4), &x, 4);
    }
  }
}

static void get_run(const weave_run_t *r, const char *restrict eight, char *restrict one) {
  const size_t wide = width[r->kind];
  if (r->kind == LANE_64) {
    for (int i = 0; i < r->n; i++) memcpy(ONE(i, 8), LANE(i, 8), 8);
  } else if (r->kind == LANE_32) {
    for (int i = 0; i < r->n; i++) memcpy(ONE(i, 4), LANE(i, 4), 4);
  } else {
    for (int i = 0; i < r->n; i++) {
      int32_t x;
      memcpy(&x, LANE(i, 4), 4);
      narrow(r->kind, x, ONE(i, wide));
    }
  }
}

weave_t weave_part(int block, size_t from, size_t to) {
  const weave_t *const all = &blocks[block];
  weave_t part = {.block = block};
  for (int i = 0; i < all->n; i++) {
    weave_run_t r = all->run[i];
    const size_t wide = width[r.kind], end = r.one + (size_t)r.n * wide;
    if (end <= from || r.one >= to) continue;
    const size_t first = r.one < from ? (from - r.one) / wide : 0;
    const size_t last = end > to ? (to - r.one) / wide : (size_t)r.n;
    r.one += (uint32_t)(first * wide);
    r.eight += (uint32_t)(first * LANES * lane_bytes(r.kind));
    r.n = (int)(last - first);
    part.run[part.n++] = r;
  }
  return part;
}

void weave_put(const weave_t *w, void *eight, int lane, const void *one) {
  for (int i = 0; i < w->n; i++) {
    const weave_run_t *const r = &w->run[i];
    put_run(r, (char *)eight + r->eight + (size_t)lane * lane_bytes(r->kind), (const char *)one + r->one);
  }
}

void weave_get(const weave_t *w, const void *eight, int lane, void *one) {
  for (int i = 0; i < w->n; i++) {
    const weave_run_t *const r = &w->run[i];
    get_run(r, (const char *)eight + r->eight + (size_t)lane * lane_bytes(r->kind), (char *)one + r->one);
  }
}

// --- of all eight ------------------------------------------------------------------------------------------

void weave_put_all(const weave_t *w, void *eight, const void *const one[LANES]) {
  for (int i = 0; i < w->n; i++) {
    const weave_run_t *const r = &w->run[i];
    char *const to = (char *)eight + r->eight;
    const char *from[LANES];
    for (int k = 0; k < LANES; k++) from[k] = (const char *)one[k] + r->one;
    if (r->kind == LANE_64)
      rows_put_64(r->n, to, from);
    else if (r->kind == LANE_32)
      rows_put_32(r->n, to, from);
    else if (r->kind == LANE_FLAG)
      rows_put_flags(r->n, to, from);
    else
      for (int k = 0; k < LANES; k++) put_run(r, to + (size_t)k * lane_bytes(r->kind), from[k]);
  }
}

static void get_run_of_all(const weave_run_t *r, const char *from, void *const one[LANES]) {
  char *to[LANES];
  for (int k = 0; k < LANES; k++) to[k] = (char *)one[k] + r->one;
  if (r->kind == LANE_64)
    rows_get_64(r->n, from, to);
  else if (r->kind == LANE_32)
    rows_get_32(r->n, from, to);
  else if (r->kind == LANE_FLAG)
    rows_get_flags(r->n, from, to);
  else
    for (int k = 0; k < LANES; k++) get_run(r, from + (size_t)k * lane_bytes(r->kind), to[k]);
}

void weave_get_all(const weave_t *w, const void *eight, void *const one[LANES]) {
  for (int i = 0; i < w->n; i++) get_run_of_all(&w->run[i], (const char *)eight + w->run[i].eight, one);
}

void weave_get_changed(const weave_t *w, const void *eight, void *was, void *const one[LANES]) {
  for (int i = 0; i < w->n; i++) {
    const weave_run_t *const r = &w->run[i];
    const char *const from = (const char *)eight + r->eight;
    char *const before = (char *)was + r->eight;
    const size_t bytes = (size_t)r->n * lane_bytes(r->kind) * LANES;
    if (memcmp(from, before, bytes) == 0) continue;
    memcpy(before, from, bytes);
    get_run_of_all(r, from, one);
  }
}
