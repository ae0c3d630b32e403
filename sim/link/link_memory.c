// link_memory.c - port 4: the memories that a client may read and write. There is one, for trajectories.
#include "link/link.h"

#include <string.h>

enum { PORT = 4, LIST = 0, READ = 1, WRITE = 2 };
enum { COUNT = 1, DETAILS = 2 };

#define TRAJECTORIES 0x12
#define HEAD         5 // number and address
#define READ_MAX     24
#define FAILED_IO    5

static bool list(link_t *l, const request_packet_t *r) {
  uint8_t out[LINK_DATA_MAX] = {r->data[0], 1};
  if (r->data[0] == COUNT) {
    link_answer(l, PORT, LIST, out, 2);
    return true;
  }
  if (r->data[0] != DETAILS || r->size < 2) return false;
  out[1] = r->data[1];
  const uint32_t size = PLANNER_MEMORY;
  if (r->data[1] == 0) {
    out[2] = TRAJECTORIES;
    memcpy(out + 3, &size, sizeof size);
  }
  link_answer(l, PORT, LIST, out, r->data[1] == 0 ? 15 : 2);
  return true;
}

bool link_memory(link_t *l, const request_packet_t *r) {
  if (r->channel == LIST) return r->size > 0 && list(l, r);
  if (r->size < HEAD || (r->channel == READ && r->size < HEAD + 1) || r->channel > WRITE) return false;
  uint8_t *const memory = l->firmware->commanded.planner.memory;
  const uint32_t at = link_u32(r->data + 1);
  const uint32_t n = r->channel == READ ? r->data[HEAD] : (uint32_t)(r->size - HEAD);
  const bool inside = r->data[0] == 0 && n <= READ_MAX + (r->channel == WRITE) && at <= PLANNER_MEMORY &&
                      n <= PLANNER_MEMORY - at;
  uint8_t out[LINK_DATA_MAX];
  memcpy(out, r->data, HEAD);
  out[HEAD] = inside ? 0 : FAILED_IO;
  if (inside && r->channel == READ) memcpy(out + HEAD + 1, memory + at, n);
  if (inside && r->channel == WRITE) memcpy(memory + at, r->data + HEAD, n);
  link_answer(l, PORT, r->channel, out, HEAD + 1 + (inside && r->channel == READ ? (int)n : 0));
  return true;
}
