// link_params.c - port 2: parameters listed, read, written, stored.
#include "link/link.h"

#include "crazyflie/param.h"
#include "crazyflie/values.h"
#include <math.h>
#include <string.h>

enum { PORT = 2, TOC = 0, READ = 1, WRITE = 2, MISC = 3 };
enum { BY_NAME, UPDATED, OLD_EXTENDED, STORE, STATE, CLEAR, OLD_DEFAULT, EXTENDED, DEFAULT };
enum { NOT_THERE = 2, REFUSED = 13, WRONG_TYPE = 22 };

#define EXTENDED_BIT 0x10

static uint8_t type_of(const firmware_row_t *row) {
  return (uint8_t)((row->type & 0xff) | (row->type & PARAM_PERSISTENT ? EXTENDED_BIT : 0));
}

int link_param_bytes(int type) {
  return 1 << (type & 3);
}

static int put(const link_t *l, uint8_t *to, int param, double value) {
  const int type = firmware_param_row(l->firmware, param).type;
  values_put(type, to, value);
  return link_param_bytes(type);
}

static link_list_t all(const link_t *l) {
  return (link_list_t){.port = PORT,
                       .n = firmware_params(l->firmware),
                       .row = firmware_param_row,
                       .type = type_of,
                       .crc = l->param_crc};
}

void link_params_init(link_t *l) {
  const link_list_t list = all(l);
  l->param_crc = link_list_crc(l, &list);
}

static void tell_value(link_t *l, int i, const uint8_t *id) {
  uint8_t out[LINK_DATA_MAX] = {id[0], id[1]};
  int size = 3;
  if (i >= firmware_params(l->firmware))
    out[2] = NOT_THERE;
  else
    size += put(l, out + 3, i, firmware_param(l->firmware, i));
  link_answer(l, PORT, READ, out, size);
}

// Writes a parameter. The answer is the packet, so that it echoes what was sent.
static void take_value(link_t *l, int i, const request_packet_t *r) {
  uint8_t out[LINK_DATA_MAX];
  memcpy(out, r->data, sizeof out);
  if (i >= firmware_params(l->firmware)) {
    out[2] = NOT_THERE;
    link_answer(l, PORT, WRITE, out, 3);
    return;
  }
  const int type = firmware_param_row(l->firmware, i).type;
  if (type & PARAM_RONLY || r->size < 2 + link_param_bytes(type)) return; // no answer, as in the firmware
  link_answer(l, PORT, WRITE, out, r->size);
  firmware_param_set(l->firmware, i, values_of_param(type, r->data + 2));
}

static size_t length(const char *text, size_t most) {
  const char *const end = memchr(text, 0, most);
  return end ? (size_t)(end - text) : most;
}

// The packet has "group\0name\0", type, value.
static bool write_by_name(link_t *l, const request_packet_t *r) {
  const char *const group = (const char *)r->data + 1;
  const size_t left = LINK_DATA_MAX - 1, n = length(group, left);
  if (n == left) return false;
  const char *const name = group + n + 1;
  const size_t m = length(name, left - n - 1);
  if (n + m + 3 > left) return false;
  char full[2 * LINK_DATA_MAX];
  memcpy(full, group, n);
  full[n] = '.';
  memcpy(full + n + 1, name, m + 1);
  const uint8_t *const at = (const uint8_t *)name + m + 1;
  const int i = firmware_param_find(l->firmware, full);
  const int type = i < 0 ? 0 : firmware_param_row(l->firmware, i).type;
  const int bytes = link_param_bytes(type), behind = (int)(at + 1 - r->data);
  uint8_t out[LINK_DATA_MAX];
  memcpy(out, r->data, sizeof out);
  const bool fits = i >= 0 && (type & 0x0f) == at[0] && behind + bytes <= r->size;
  out[behind - 1] = i < 0 ? NOT_THERE : !fits ? WRONG_TYPE : type & PARAM_RONLY ? REFUSED : 0;
  if (out[behind - 1] == 0) firmware_param_set(l->firmware, i, values_of_param(type, at + 1));
  link_answer(l, PORT, MISC, out, behind);
  return true;
}

// --- what is stored ----------------------------------------------------------------------------------------

static int tell_state(link_t *l, int i, uint8_t *out) {
  const double stored = l->storage->value[i];
  const bool is_stored = stored == stored;
  int size = 1;
  out[0] = (uint8_t)is_stored;
  size += put(l, out + size, i, firmware_param_default(l->firmware, i));
  if (is_stored) size += put(l, out + size, i, stored);
  return size;
}

static uint8_t store(link_t *l, int i, bool keep) {
  const bool can = firmware_param_row(l->firmware, i).type & PARAM_PERSISTENT;
  const double value = keep ? firmware_param(l->firmware, i) : (double)NAN;
  return can && storage_put(l->storage, l->firmware, i, value) ? 0 : NOT_THERE;
}

static int tell_default(const link_t *l, int i, uint8_t *out) {
  if (firmware_param_row(l->firmware, i).type & PARAM_RONLY) return 1;
  out[0] = 0;
  return 1 + put(l, out + 1, i, firmware_param_default(l->firmware, i));
}

// Writes the answer about parameter i, which exists, to out, behind command and number; out[0] is NOT_THERE
// so far. Returns how many bytes; 0: not understood.
static int of_one(link_t *l, uint8_t what, int i, uint8_t *out) {
  const bool persistent = firmware_param_row(l->firmware, i).type & PARAM_PERSISTENT;
  switch (what) {
  case OLD_EXTENDED: out[0] = persistent; return 1;
  case EXTENDED:
    if (!persistent) return 1;
    out[0] = 0, out[1] = 1;
    return 2;
  case STORE: out[0] = store(l, i, true); return 1;
  case CLEAR: out[0] = store(l, i, false); return 1;
  case STATE: return tell_state(l, i, out);
  case OLD_DEFAULT: return put(l, out, i, firmware_param_default(l->firmware, i));
  case DEFAULT: return tell_default(l, i, out);
  default: return 0;
  }
}

static bool misc(link_t *l, const request_packet_t *r) {
  if (r->data[0] == BY_NAME) return write_by_name(l, r);
  if (r->size < 3 || r->data[0] == UPDATED || r->data[0] > DEFAULT) return false;
  const int i = link_u16(r->data + 1);
  uint8_t out[LINK_DATA_MAX] = {r->data[0], r->data[1], r->data[2], NOT_THERE};
  const int size = i < firmware_params(l->firmware) ? of_one(l, r->data[0], i, out + 3) : 1;
  link_answer(l, PORT, MISC, out, 3 + size);
  return true;
}

bool link_params(link_t *l, const request_packet_t *r) {
  if (r->size < 1) return false;
  const link_list_t list = all(l);
  if (r->channel == TOC) return link_list(l, &list, r);
  if (r->channel == MISC) return misc(l, r);
  if (r->size < 2) return false;
  const int i = link_u16(r->data);
  if (r->channel == READ)
    tell_value(l, i, r->data);
  else
    take_value(l, i, r);
  return true;
}

void link_params_changed(void *link, int i) {
  link_t *const l = link;
  uint8_t out[LINK_DATA_MAX] = {UPDATED, (uint8_t)i, (uint8_t)(i >> 8)};
  link_answer(l, PORT, MISC, out, 3 + put(l, out + 3, i, firmware_param(l->firmware, i)));
}
