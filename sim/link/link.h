// link.h - the radio link of a Crazyflie, as its client library speaks it: datagrams in, datagrams out.
//
// A packet is one header byte (port << 4 | 0x0C | channel) and 0 to 30 bytes. What it understands: source and
// echo (15), platform (13), logs (5), parameters (2), memories (4), set points (3, 7), high-level commands
// (8), supervisor (9), localization (6: the emergency stop; positions are taken, and not used), console (0).
// Every request is answered, in the order of arrival. One that is malformed or of no known kind is answered
// as the firmware does, or dropped and counted.
//
// Source: bitcraze/crazyflie-firmware 2a18fc29 (log.c, param_logic.c, mem.c, crtp_*.c, platformservice.c),
// and what cflib 0.1.34 sends. Own code.
#ifndef SIM_LINK_LINK_H
#define SIM_LINK_LINK_H

#include "crazyflie/firmware.h"
#include "crazyflie/storage.h"
#include <stdint.h>

#define LINK_DATA_MAX 30
#define LINK_QUEUE    512 // answers that can wait

typedef struct {
  uint8_t size; // of header and data: 1..31
  uint8_t byte[1 + LINK_DATA_MAX];
} packet_t;

// --- logs: blocks of variables that a client asks for ------------------------------------------------------

#define LINK_BLOCKS 16
#define LINK_OPS    128 // variables in all blocks
#define LINK_OF     26  // bytes of values in a block

typedef struct {
  int log;      // firmware_log_row
  uint8_t type; // as it is sent: of log.h, or 8, half a float
} link_op_t;

typedef struct {
  bool used, runs;
  uint8_t id;
  uint32_t period_ms, due_ms;
  int n;
  link_op_t op[LINK_OF];
} link_block_t;

typedef struct {
  firmware_t *firmware;
  storage_t *storage;
  link_block_t block[LINK_BLOCKS];
  packet_t queue[LINK_QUEUE];
  unsigned put, taken;             // counters that wrap; the answers between them wait
  uint32_t log_crc, param_crc;     // of names and types
  uint32_t in, out, dropped, lost; // packets: taken, given, not understood, no room for the answer
} link_t;

// *l must stay where it is: the firmware tells it of changed parameters.
void link_init(link_t *l, firmware_t *firmware, storage_t *storage);

// Takes a datagram of the client: any bytes, any size.
void link_take(link_t *l, const uint8_t *bytes, int size);

// To be called after each millisecond of the firmware: queues log blocks that are due, and the console.
void link_ms(link_t *l);

// Takes the next datagram to the client from the queue; false: none waits.
bool link_give(link_t *l, packet_t *packet);

// The client has gone: ends its log blocks, drops what waits, and on the ground drops its priority as well.
void link_reset(link_t *l);

// To be called when the firmware, and its clock, have started anew while the link stayed up: running log
// blocks go on.
void link_restarted(link_t *l);

// --- the inside: one file a port --------------------------------------------------------------------------

// A request without its header. data has `size` bytes, at most LINK_DATA_MAX; the rest is 0.
typedef struct {
  uint8_t channel;
  int size;
  uint8_t data[LINK_DATA_MAX];
} request_packet_t;

// The list of parameters, or of logs, which clients cache by its checksum.
typedef struct {
  int port, n;
  firmware_row_t (*row)(const firmware_t *f, int i);
  uint8_t (*type)(const firmware_row_t *row); // as sent over the link
  uint32_t crc;
  uint8_t more[2]; // what follows count and checksum
  int n_more;
} link_list_t;

uint32_t link_list_crc(const link_t *l, const link_list_t *list);
// Answers a request on channel 0 of the list's port. False: not understood.
bool link_list(link_t *l, const link_list_t *list, const request_packet_t *r);

void link_answer(link_t *l, int port, int channel, const void *data, int size);

// False: not understood.
bool link_logs(link_t *l, const request_packet_t *r);
bool link_params(link_t *l, const request_packet_t *r);
bool link_memory(link_t *l, const request_packet_t *r);

void link_logs_init(link_t *l);
void link_logs_ms(link_t *l);
void link_logs_reset(link_t *l);
void link_logs_restart(link_t *l);
void link_params_init(link_t *l);
void link_params_changed(void *link, int param);

// Numbers as they stand in packets; how many bytes a parameter of a type of param.h has.
uint16_t link_u16(const uint8_t *at);
uint32_t link_u32(const uint8_t *at);
int link_param_bytes(int type);

#endif
