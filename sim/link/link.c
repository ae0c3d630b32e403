// link.c - the radio link of a Crazyflie.
#include "link/link.h"

#include <string.h>

enum {
  CONSOLE,
  PARAMS = 2,
  PAD,
  MEMORY,
  LOGS,
  PLACE,
  SET_POINTS,
  HIGH_LEVEL,
  SUPERVISOR,
  PLATFORM = 13,
  LINK = 15
};

#define PROTOCOL_VERSION 12
#define SOURCE           "Bitcraze Crazyflie"
#define DEVICE           "CF21"

uint16_t link_u16(const uint8_t *at) {
  return (uint16_t)(at[0] | at[1] << 8);
}
uint32_t link_u32(const uint8_t *at) {
  return link_u16(at) | (uint32_t)link_u16(at + 2) << 16;
}

// --- the queue ---------------------------------------------------------------------------------------------

void link_answer(link_t *l, int port, int channel, const void *data, int size) {
  if (l->put - l->taken == LINK_QUEUE) {
    l->lost++;
    return;
  }
  packet_t *const p = &l->queue[l->put++ % LINK_QUEUE];
  p->size = (uint8_t)(1 + size);
  p->byte[0] = (uint8_t)(port << 4 | 0x0c | channel);
  memcpy(p->byte + 1, data, (size_t)size);
}

bool link_give(link_t *l, packet_t *packet) {
  if (l->put == l->taken) return false;
  *packet = l->queue[l->taken++ % LINK_QUEUE];
  l->out++;
  return true;
}

// A session of the client library ends with a set point of zeros. Over a radio it hardly ever arrives; here
// it always does, and its priority would keep the planner from flying in the next session. On the ground the
// priority is dropped.
void link_reset(link_t *l) {
  link_logs_reset(l);
  if (!supervised_flies(&l->firmware->vehicle.supervised)) commanded_let_go(&l->firmware->commanded);
  l->taken = l->put;
}

void link_restarted(link_t *l) {
  link_logs_restart(l);
}

// --- the small ports ---------------------------------------------------------------------------------------

static bool echo_and_source(link_t *l, const request_packet_t *r) {
  uint8_t source[LINK_DATA_MAX] = SOURCE;
  switch (r->channel) {
  case 0: link_answer(l, LINK, 0, r->data, r->size); return true;
  case 1: link_answer(l, LINK, 1, source, sizeof source); return true;
  case 2: return true; // sink
  default: link_answer(l, LINK, 3, "", 0); return true;
  }
}

static bool version(link_t *l, const request_packet_t *r) {
  static const char *const says[] = {NULL, "", DEVICE};
  const uint8_t number[] = {0, PROTOCOL_VERSION, 0, 0, 0};
  uint8_t text[LINK_DATA_MAX] = {r->data[0]};
  if (r->data[0] == 0) link_answer(l, PLATFORM, 1, number, sizeof number);
  if (r->data[0] == 0) return true;
  if (r->data[0] > 2) return false;
  const size_t n = strlen(says[r->data[0]]) + 1;
  memcpy(text + 1, says[r->data[0]], n);
  link_answer(l, PLATFORM, 1, text, (int)(1 + n));
  return true;
}

enum { ARM = 1, RECOVER, EMERGENCY_STOP, FEED };

static bool arm_or_recover(link_t *l, int port, int channel, uint8_t reply, const request_packet_t *r) {
  if (r->data[0] == ARM && r->size < 2) return false;
  supervised_t *const s = &l->firmware->vehicle.supervised;
  const bool arms = r->data[0] == ARM;
  const bool done = arms ? supervised_arm(s, r->data[1] != 0) : supervised_recover(s);
  const uint8_t answer[] = {reply, done, arms ? s->armed : !s->crashed};
  link_answer(l, port, channel, answer, sizeof answer);
  return true;
}

// Older clients arm here.
static bool platform(link_t *l, const request_packet_t *r) {
  if (r->channel == 1) return r->size > 0 && version(l, r);
  if (r->channel == 2) return true; // for packets of an app, and this app takes none
  if (r->channel != 0 || r->size < 1) return false;
  if (r->data[0] == ARM || r->data[0] == RECOVER) return arm_or_recover(l, PLATFORM, 0, r->data[0], r);
  link_answer(l, PLATFORM, 0, r->data, r->data[0] == 3 ? 0 : r->size);
  return true;
}

#define REPLY     0x80
#define INFO_BITS 11
#define INFO_ALL  12

static bool stop_or_feed(firmware_t *f, uint8_t what) {
  if (what == EMERGENCY_STOP) f->emergency = true;
  if (what == FEED) f->vehicle.around.fed_ms = firmware_now_ms(f);
  return what == EMERGENCY_STOP || what == FEED;
}

// Localization, where older clients send the emergency stop. Positions are taken, and not used.
static bool place(link_t *l, const request_packet_t *r) {
  if (r->channel == 1 && r->size > 0) (void)stop_or_feed(l->firmware, r->data[0]);
  return true;
}

static bool supervisor(link_t *l, const request_packet_t *r) {
  firmware_t *const f = l->firmware;
  if (r->size < 1) return false;
  const uint8_t what = r->data[0];
  if (r->channel == 0) {
    const uint16_t info = firmware_info(f);
    const uint8_t all[] = {REPLY | what, (uint8_t)info, (uint8_t)(info >> 8)};
    const bool is_bit = what >= 1 && what <= INFO_BITS;
    uint8_t bit[] = {REPLY | what, 0};
    if (is_bit) bit[1] = (uint8_t)(info >> (what - 1) & 1);
    if (what == INFO_ALL)
      link_answer(l, SUPERVISOR, 0, all, sizeof all);
    else if (is_bit)
      link_answer(l, SUPERVISOR, 0, bit, sizeof bit);
    else
      return false;
    return true;
  }
  if (r->channel != 1) return false;
  if (what == ARM || what == RECOVER) return arm_or_recover(l, SUPERVISOR, 1, REPLY | what, r);
  return stop_or_feed(f, what);
}

static bool set_points(link_t *l, const request_packet_t *r) {
  commanded_t *const c = &l->firmware->commanded;
  if (r->channel == 0) return commanded_take(c, r->data, r->size, firmware_now_ms(l->firmware));
  if (r->channel != 1 || r->size < 1 || r->data[0] != 0) return false;
  commanded_relax(c);
  return true;
}

// The answer has the command's first three bytes, then its result.
static bool high_level(link_t *l, const request_packet_t *r) {
  firmware_t *const f = l->firmware;
  if (r->size < 1) return false;
  const int result = firmware_high_level(f, r->data, r->size);
  const uint8_t answer[] = {r->data[0], r->data[1], r->data[2], (uint8_t)result};
  link_answer(l, HIGH_LEVEL, r->channel, answer, sizeof answer);
  return true;
}

// --- all ---------------------------------------------------------------------------------------------------

static bool understood(link_t *l, int port, const request_packet_t *r) {
  switch (port) {
  case PARAMS: return link_params(l, r);
  case PAD:
    return r->channel == 0 &&
           commanded_take_pad(&l->firmware->commanded, r->data, r->size, firmware_now_ms(l->firmware));
  case MEMORY: return link_memory(l, r);
  case LOGS: return link_logs(l, r);
  case PLACE: return place(l, r);
  case SET_POINTS: return set_points(l, r);
  case HIGH_LEVEL: return high_level(l, r);
  case SUPERVISOR: return supervisor(l, r);
  case PLATFORM: return platform(l, r);
  case LINK: return echo_and_source(l, r);
  default: return false;
  }
}

void link_init(link_t *l, firmware_t *firmware, storage_t *storage) {
  memset(l, 0, sizeof *l);
  l->firmware = firmware;
  l->storage = storage;
  link_logs_init(l);
  link_params_init(l);
  firmware->changed = link_params_changed;
  firmware->changed_context = l;
}

void link_take(link_t *l, const uint8_t *bytes, int size) {
  l->in++;
  if (size < 1 || size > 1 + LINK_DATA_MAX) {
    l->dropped++;
    return;
  }
  request_packet_t r = {.channel = bytes[0] & 3, .size = size - 1};
  memcpy(r.data, bytes + 1, (size_t)r.size);
  l->dropped += !understood(l, bytes[0] >> 4, &r);
}

static void print(link_t *l) {
  char text[LINK_DATA_MAX + 1];
  while (l->put - l->taken < LINK_QUEUE / 2) {
    const int n = firmware_console(l->firmware, text, sizeof text);
    if (n == 0) return;
    link_answer(l, CONSOLE, 0, text, n);
  }
}

void link_ms(link_t *l) {
  link_logs_ms(l);
  print(l);
}
