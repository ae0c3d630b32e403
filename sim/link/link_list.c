// link_list.c - the lists of parameters and of logs: their length, the checksum by which a client knows a
// list, and each item.
#include "link/link.h"

#include <string.h>
#include <zlib.h>

enum { ITEM = 2, INFO = 3 };

static uint32_t add(uint32_t crc, const void *bytes, size_t n) {
  return (uint32_t)crc32(crc, bytes, (unsigned)n);
}

// Returns a checksum that changes when a name or a type does.
uint32_t link_list_crc(const link_t *l, const link_list_t *list) {
  uint32_t crc = add(0, NULL, 0);
  for (int i = 0; i < list->n; i++) {
    const firmware_row_t row = list->row(l->firmware, i);
    const uint8_t type = list->type(&row);
    crc = add(add(add(crc, &type, 1), row.group, strlen(row.group) + 1), row.name, strlen(row.name) + 1);
  }
  return crc;
}

static int tell_all(const link_list_t *list, uint8_t *out) {
  const uint16_t n = (uint16_t)list->n;
  memcpy(out + 1, &n, sizeof n);
  memcpy(out + 3, &list->crc, sizeof list->crc);
  memcpy(out + 7, list->more, (size_t)list->n_more);
  return 7 + list->n_more;
}

static int tell_one(const link_t *l, const link_list_t *list, int i, uint8_t *out) {
  const firmware_row_t row = list->row(l->firmware, i);
  const size_t group = strlen(row.group) + 1, name = strlen(row.name) + 1; // 26 characters at most (firmware)
  out[1] = (uint8_t)i;
  out[2] = (uint8_t)(i >> 8);
  out[3] = list->type(&row);
  memcpy(out + 4, row.group, group);
  memcpy(out + 4 + group, row.name, name);
  return (int)(4 + group + name);
}

bool link_list(link_t *l, const link_list_t *list, const request_packet_t *r) {
  uint8_t out[LINK_DATA_MAX] = {r->data[0]};
  const int i = link_u16(r->data + 1);
  int size = 1; // there is none of that number
  if (r->data[0] == INFO)
    size = tell_all(list, out);
  else if (r->data[0] != ITEM)
    return false;
  else if (i < list->n && r->size >= 3)
    size = tell_one(l, list, i, out);
  link_answer(l, list->port, 0, out, size);
  return true;
}
