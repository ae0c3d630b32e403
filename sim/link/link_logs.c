// link_logs.c - port 5: the list of logs, and blocks of them.
#include "link/link.h"

#include <math.h>
#include <string.h>

enum { PORT = 5, TOC = 0, CONTROL = 1, DATA = 2 };
enum { DELETE = 2, RUN, HALT, RESET, CREATE, APPEND, RUN_MS };
enum { NO_BLOCK = 2, TOO_BIG = 7, BAD_COMMAND = 8, NO_MEMORY = 12, EXISTS = 17 };

#define FP16 8
#define OP   3 // bytes of a variable in a request: type, then number

static const int bytes_of[] = {0, 1, 2, 4, 1, 2, 4, 4, 2}; // log.h

static uint8_t type_of(const firmware_row_t *row) {
  return (uint8_t)(row->type & 0x0f);
}

static link_list_t all(const link_t *l) {
  return (link_list_t){.port = PORT,
                       .n = firmware_logs(l->firmware),
                       .row = firmware_log_row,
                       .type = type_of,
                       .crc = l->log_crc,
                       .more = {LINK_BLOCKS, LINK_OPS},
                       .n_more = 2};
}

void link_logs_init(link_t *l) {
  const link_list_t list = all(l);
  l->log_crc = link_list_crc(l, &list);
}

// --- blocks ------------------------------------------------------------------------------------------------

static link_block_t *find(link_t *l, uint8_t id) {
  for (int i = 0; i < LINK_BLOCKS; i++)
    if (l->block[i].used && l->block[i].id == id) return &l->block[i];
  return NULL;
}

static int size_of(const link_block_t *b) {
  int sum = 0;
  for (int i = 0; i < b->n; i++) sum += bytes_of[b->op[i].type];
  return sum;
}

static int ops(const link_t *l) {
  int sum = 0;
  for (int i = 0; i < LINK_BLOCKS; i++) sum += l->block[i].used ? l->block[i].n : 0;
  return sum;
}

static int append(link_t *l, const request_packet_t *r) {
  link_block_t *const b = find(l, r->data[1]);
  if (!b) return NO_BLOCK;
  for (const uint8_t *at = r->data + 2; at + OP <= r->data + r->size; at += OP) {
    const uint8_t type = at[0] & 0x0f;
    if (type == 0 || type > FP16) return NO_BLOCK;
    if (size_of(b) + bytes_of[type] > LINK_OF) return TOO_BIG;
    if (ops(l) == LINK_OPS) return NO_MEMORY;
    if (link_u16(at + 1) >= firmware_logs(l->firmware)) return NO_BLOCK;
    b->op[b->n++] = (link_op_t){link_u16(at + 1), type};
  }
  return 0;
}

static int create(link_t *l, const request_packet_t *r) {
  if (find(l, r->data[1])) return EXISTS;
  for (int i = 0; i < LINK_BLOCKS; i++) {
    if (l->block[i].used) continue;
    l->block[i] = (link_block_t){.used = true, .id = r->data[1]};
    return append(l, r);
  }
  return NO_MEMORY;
}

static int run(link_t *l, uint8_t id, uint32_t period_ms) {
  link_block_t *const b = find(l, id);
  if (!b) return NO_BLOCK;
  b->runs = true;
  b->period_ms = period_ms;
  b->due_ms = firmware_now_ms(l->firmware) + period_ms;
  return 0;
}

static int halt(link_t *l, uint8_t id) {
  link_block_t *const b = find(l, id);
  if (b) b->runs = false;
  return b ? 0 : NO_BLOCK;
}

static int drop(link_t *l, uint8_t id) {
  link_block_t *const b = find(l, id);
  if (b) b->used = false;
  return b ? 0 : NO_BLOCK;
}

void link_logs_reset(link_t *l) {
  for (int i = 0; i < LINK_BLOCKS; i++) l->block[i].used = false;
}

void link_logs_restart(link_t *l) {
  for (int i = 0; i < LINK_BLOCKS; i++)
    l->block[i].due_ms = firmware_now_ms(l->firmware) + l->block[i].period_ms;
}

// The least number of bytes of a command.
static int least(uint8_t what) {
  return what == RESET ? 1 : what == RUN ? 3 : what == RUN_MS ? 4 : 2;
}

static int control(link_t *l, const request_packet_t *r) {
  switch (r->data[0]) {
  case DELETE: return drop(l, r->data[1]);
  case RUN: return run(l, r->data[1], 10u * r->data[2]);
  case HALT: return halt(l, r->data[1]);
  case RESET: link_logs_reset(l); return 0;
  case CREATE: return create(l, r);
  case APPEND: return append(l, r);
  case RUN_MS: return run(l, r->data[1], link_u16(r->data + 2));
  default: return BAD_COMMAND;
  }
}

bool link_logs(link_t *l, const request_packet_t *r) {
  if (r->size < 1) return false;
  const link_list_t list = all(l);
  if (r->channel == TOC) return link_list(l, &list, r);
  if (r->channel != CONTROL || r->size < least(r->data[0])) return false;
  const uint8_t answer[] = {r->data[0], r->data[1], (uint8_t)control(l, r)};
  link_answer(l, PORT, CONTROL, answer, sizeof answer);
  return true;
}

// --- data --------------------------------------------------------------------------------------------------

// Converts to half precision, rounding to nearest even; what is too large becomes infinite.
static uint16_t half_of(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  const uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
  const float size = fabsf(value);
  if (isnan(value)) return sign | 0x7e00;
  if (size >= 65520.0f) return sign | 0x7c00;
  if (size < 6.1035156e-05f) return sign | (uint16_t)rintf(size * 16777216.0f);
  bits &= 0x7fffffff;
  const uint32_t rounded = bits + 0xfff + (bits >> 13 & 1);
  return sign | (uint16_t)((rounded >> 13) - (112u << 10));
}

// Whole numbers as in the firmware: truncated, and the low bytes sent.
static int pack(uint8_t *to, uint8_t type, double value) {
  const float real = (float)value;
  const uint16_t half = half_of(real);
  const double cut = isnan(value) ? 0.0 : fmin(fmax(trunc(value), -2147483648.0), 4294967295.0);
  const uint32_t whole = (uint32_t)(int64_t)cut;
  memcpy(to,
         type == 7      ? (const void *)&real
         : type == FP16 ? (const void *)&half
                        : (const void *)&whole,
         (size_t)bytes_of[type]);
  return bytes_of[type];
}

static void send(link_t *l, const link_block_t *b) {
  const uint32_t now_ms = firmware_now_ms(l->firmware);
  uint8_t out[LINK_DATA_MAX] = {b->id, (uint8_t)now_ms, (uint8_t)(now_ms >> 8), (uint8_t)(now_ms >> 16)};
  int size = 4;
  for (int i = 0; i < b->n; i++)
    size += pack(out + size, b->op[i].type, firmware_log(l->firmware, b->op[i].log));
  link_answer(l, PORT, DATA, out, size);
}

void link_logs_ms(link_t *l) {
  const uint32_t now_ms = firmware_now_ms(l->firmware);
  bool looked = false;
  for (int i = 0; i < LINK_BLOCKS; i++) {
    link_block_t *const b = &l->block[i];
    if (!b->used || !b->runs || (int32_t)(now_ms - b->due_ms) < 0) continue;
    if (!looked) firmware_look(l->firmware);
    looked = true;
    send(l, b);
    b->due_ms += b->period_ms;
    if (b->period_ms == 0) b->runs = false; // once
  }
}
