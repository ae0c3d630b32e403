// datagrams.h - the datagrams between one vehicle and its client: a UDP socket, and what the air in between
// loses, delays and puts out of order.
//
// One client at a time. Another one takes its place with the first packet of a session, a request for the
// source (15.1 with a 0), or with any packet once the one before has sent nothing for DATAGRAMS_SILENT_S and
// so has gone. Who only looks who is there (a byte 0xFF) gets it back; whatever else comes from elsewhere is
// dropped.
#ifndef SIM_DESK_DATAGRAMS_H
#define SIM_DESK_DATAGRAMS_H

#include "base/error.h"
#include "base/random.h"
#include "link/link.h"
#include <netinet/in.h>
#include <stdbool.h>
#include <stdint.h>

#define DATAGRAMS_SILENT_S 2.0
#define DATAGRAMS_HELD     256 // packets under way, each direction
#define DATAGRAMS_BYTES    64  // of a datagram that are looked at; longer ones are none of ours

typedef struct {
  uint32_t due_ms;
  int size;
  uint8_t byte[DATAGRAMS_BYTES];
} held_t;

typedef struct {
  held_t held[DATAGRAMS_HELD];
  int n;
} air_t;

typedef struct {
  int socket, port;
  struct sockaddr_in client;
  bool has_client, changed; // another one came in its place
  double heard_s;           // last, by the clock on the wall
  air_t up, down;
  random_t *random;
  double loss, delay_s;   // share of packets; each is delayed by half to one and a half times this
  uint32_t lost, dropped; // in the air; of others than the client, or empty
} datagrams_t;

// Port 0: any that is free. BAD_INPUT: it cannot be listened on. FAILED: no memory, no socket. On error there
// is nothing to close.
MUST_CHECK done_t datagrams_open(datagrams_t *r, struct in_addr address, int port, uint64_t seed, why_t *why);
void datagrams_close(datagrams_t *r);

// Takes what has come from the socket. wall_s: the clock.
void datagrams_listen(datagrams_t *r, double wall_s, uint32_t now_ms);

// The next packet that is through the air; 0: none. At most DATAGRAMS_BYTES.
int datagrams_receive(datagrams_t *r, uint32_t now_ms, uint8_t bytes[DATAGRAMS_BYTES]);

// Sends one, and whatever is due.
void datagrams_send(datagrams_t *r, const packet_t *packet, uint32_t now_ms);
void datagrams_flush(datagrams_t *r, uint32_t now_ms);

// The client has just gone, or another one has come in its place.
bool datagrams_left(datagrams_t *r, double wall_s);

#endif
