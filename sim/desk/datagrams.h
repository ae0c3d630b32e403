// datagrams.h - the datagrams between one vehicle and its client: a UDP socket, and what the air in between
// loses, delays and puts out of order.
//
// There is one client at a time. Another takes its place with the first packet of a session, a request for
// the source (port 15, channel 1, with a 0), or with any packet once the client has sent nothing for
// DATAGRAMS_SILENT_S and so has gone. A scan (a single byte 0xFF) from elsewhere gets its byte back; anything
// else from elsewhere is dropped.
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
#define DATAGRAMS_BYTES    64  // read of a datagram; longer ones are none of ours

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
  bool has_client, changed; // another client came in the place of the last
  double heard_s;           // when it last sent something, by the wall clock
  air_t up, down;
  random_t *random;
  double loss, delay_s;   // share of packets lost; a packet is delayed by 0.5 to 1.5 times this
  uint32_t lost, dropped; // in the air; from others than the client, or empty
} datagrams_t;

// Port 0: any that is free. BAD_INPUT: address and port cannot be listened on. FAILED: no memory, no socket.
// On error there is nothing to close.
MUST_CHECK done_t datagrams_open(datagrams_t *r, struct in_addr address, int port, uint64_t seed, why_t *why);
void datagrams_close(datagrams_t *r);

// Takes what has arrived at the socket. wall_s: the wall clock.
void datagrams_listen(datagrams_t *r, double wall_s, uint32_t now_ms);

// Gives the next packet that has come through the air. Returns its size, at most DATAGRAMS_BYTES; 0: none.
int datagrams_receive(datagrams_t *r, uint32_t now_ms, uint8_t bytes[DATAGRAMS_BYTES]);

// Sends a packet, and whatever is due; datagrams_flush only what is due.
void datagrams_send(datagrams_t *r, const packet_t *packet, uint32_t now_ms);
void datagrams_flush(datagrams_t *r, uint32_t now_ms);

// True once when the client has gone, or another has come in its place.
bool datagrams_left(datagrams_t *r, double wall_s);

#endif
