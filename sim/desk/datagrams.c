// datagrams.c - the datagrams between one vehicle and its client.
#include "desk/datagrams.h"

#include "desk/address.h"
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define BURST 64 // datagrams taken in one call, so that a flood does not stop the flight

static bool bound(datagrams_t *r, struct in_addr address, int port) {
  struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr = address};
  socklen_t size = sizeof at;
  if (bind(r->socket, (const struct sockaddr *)&at, sizeof at) != 0 ||
      getsockname(r->socket, (struct sockaddr *)&at, &size) != 0)
    return false;
  r->port = ntohs(at.sin_port);
  return true;
}

done_t datagrams_open(datagrams_t *r, struct in_addr address, int port, uint64_t seed, why_t *why) {
  memset(r, 0, sizeof *r);
  r->random = random_open(seed ^ 0x52414449u);
  r->socket = socket(AF_INET, SOCK_DGRAM, 0);
  if (r->random && r->socket >= 0 && fcntl(r->socket, F_SETFL, O_NONBLOCK) == 0 && bound(r, address, port))
    return DONE;
  const int error = errno;
  const bool had = r->random && r->socket >= 0;
  datagrams_close(r);
  return had ? address_refuse(address, port, "--port", error, why)
             : error_failed(why, "no socket: %s", strerror(error));
}

void datagrams_close(datagrams_t *r) {
  if (r->socket >= 0) close(r->socket);
  random_close(r->random);
  r->socket = -1;
  r->random = NULL;
}

// --- the air ----------------------------------------------------------------------------------------------

static void put(datagrams_t *r, air_t *air, const uint8_t *bytes, int size, uint32_t now_ms) {
  if (air->n == DATAGRAMS_HELD || (r->loss > 0.0 && random_uniform(r->random, 0.0, 1.0) < r->loss)) {
    r->lost++;
    return;
  }
  held_t *const h = &air->held[air->n++];
  const double delay_ms = r->delay_s > 0.0 ? 1e3 * r->delay_s * random_uniform(r->random, 0.5, 1.5) : 0.0;
  h->due_ms = now_ms + (uint32_t)delay_ms;
  h->size = size;
  memcpy(h->byte, bytes, (size_t)size);
}

// Takes out the packet that has been due for longest; those behind it keep their order.
static bool take(air_t *air, uint32_t now_ms, held_t *held) {
  int first = -1;
  for (int i = 0; i < air->n; i++) {
    if ((int32_t)(now_ms - air->held[i].due_ms) < 0) continue;
    if (first < 0 || (int32_t)(air->held[first].due_ms - air->held[i].due_ms) > 0) first = i;
  }
  if (first < 0) return false;
  *held = air->held[first];
  air->n--;
  memmove(&air->held[first], &air->held[first + 1], (size_t)(air->n - first) * sizeof *air->held);
  return true;
}

// --- the socket -------------------------------------------------------------------------------------------

static bool same(const struct sockaddr_in *a, const struct sockaddr_in *b) {
  return a->sin_port == b->sin_port && a->sin_addr.s_addr == b->sin_addr.s_addr;
}

// True for the first packet of a session.
static bool begins(const uint8_t *bytes, ssize_t n) {
  return n == 2 && bytes[0] == 0xfd && bytes[1] == 0;
}

// Packets under way from and to the client before are lost: they are not this client's.
static void change(datagrams_t *r, const struct sockaddr_in *client) {
  r->lost += (uint32_t)(r->up.n + r->down.n);
  r->up.n = r->down.n = 0;
  r->changed = r->has_client;
  r->client = *client;
  r->has_client = true;
}

static void hear(datagrams_t *r, const struct sockaddr_in *from, const uint8_t *bytes, ssize_t n,
                 double wall_s, uint32_t now_ms) {
  const bool known = r->has_client && same(from, &r->client);
  if (n == 1 && bytes[0] == 0xff && !known) {
    (void)!sendto(r->socket, bytes, 1, 0, (const struct sockaddr *)from, sizeof *from);
    return;
  }
  if (n == 0 || (r->has_client && !known && !begins(bytes, n))) {
    r->dropped++;
    return;
  }
  if (!known) change(r, from);
  r->heard_s = wall_s;
  put(r, &r->up, bytes, (int)n, now_ms);
}

void datagrams_listen(datagrams_t *r, double wall_s, uint32_t now_ms) {
  uint8_t bytes[DATAGRAMS_BYTES];
  struct sockaddr_in from;
  for (int i = 0; i < BURST; i++) {
    socklen_t length = sizeof from;
    const ssize_t n = recvfrom(r->socket, bytes, sizeof bytes, 0, (struct sockaddr *)&from, &length);
    if (n < 0 && errno == ECONNREFUSED) continue; // caused by something sent to a client that has gone
    if (n < 0) return;
    hear(r, &from, bytes, n, wall_s, now_ms);
  }
}

int datagrams_receive(datagrams_t *r, uint32_t now_ms, uint8_t bytes[DATAGRAMS_BYTES]) {
  held_t held;
  if (!take(&r->up, now_ms, &held)) return 0;
  memcpy(bytes, held.byte, (size_t)held.size);
  return held.size;
}

void datagrams_flush(datagrams_t *r, uint32_t now_ms) {
  held_t held;
  while (take(&r->down, now_ms, &held))
    if (r->has_client)
      (void)!sendto(r->socket, held.byte, (size_t)held.size, 0, (const struct sockaddr *)&r->client,
                    sizeof r->client);
}

void datagrams_send(datagrams_t *r, const packet_t *packet, uint32_t now_ms) {
  put(r, &r->down, packet->byte, packet->size, now_ms);
  datagrams_flush(r, now_ms);
}

bool datagrams_left(datagrams_t *r, double wall_s) {
  const bool changed = r->changed;
  r->changed = false;
  if (changed) return true;
  if (!r->has_client || wall_s - r->heard_s < DATAGRAMS_SILENT_S) return false;
  r->has_client = false;
  return true;
}
