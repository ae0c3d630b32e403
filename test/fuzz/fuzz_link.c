// fuzz_link.c - any datagrams to a vehicle at the desk that flies, at any distance.
#include "drone/drone.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define TICKS_MAX 1000 // of one input: 2 s

static void answered(drone_t *d) {
  for (packet_t p; link_give(&d->link, &p);)
    if (p.size < 1 || p.size > 1 + LINK_DATA_MAX) abort();
}

static void fly(drone_t *d, int ticks) {
  why_t why;
  for (; ticks > 0; ticks--) {
    if (drone_tick(d, &why) != DONE) abort();
    answered(d);
  }
}

// In the air, with the app flying: a take-off to 0.5 m within 1 s, as the client sends it.
static void take_off(drone_t *d) {
  static const uint8_t up[16] = {0x8c, 7, 0, 0, 0, 0, 0x3f, 0, 0, 0, 0, 1, 0, 0, 0x80, 0x3f};
  fly(d, 250);
  const int shadow = firmware_param_find(&d->firmware, "ceil.shadow");
  drone_take(d, (uint8_t[]){0x2e, (uint8_t)shadow, (uint8_t)(shadow >> 8), 0}, 4);
  drone_take(d, up, sizeof up);
  fly(d, 500);
}

// Mostly of a port and channel that something listens on.
static uint8_t header(uint8_t drawn) {
  static const uint8_t known[] = {0x2c, 0x2d, 0x2e, 0x2f, 0x3c, 0x4c, 0x4d, 0x4e, 0x5c, 0x5d, 0x6c,
                                  0x6d, 0x7c, 0x7d, 0x8c, 0x9c, 0x9d, 0xdc, 0xdd, 0xfc, 0xfd, 0xff};
  return drawn < 240 ? known[drawn % sizeof known] : drawn;
}

// Each packet: its size, how many ticks of 2 ms later the next one comes, its bytes.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static drone_t drone;
  static scene_t scene;
  why_t why;
  if (scene.battery == 0.0 && scene_default(&scene, &why) != DONE) abort();
  if (drone_open(&drone, &scene, NULL, NULL, NULL, &why) != DONE) abort();
  if (size > 0 && data[0] & 1) take_off(&drone);
  int ticks = 0;
  for (size_t at = 1; at + 2 <= size && ticks < TICKS_MAX;) {
    const size_t wanted = data[at] % 40u, left = size - at - 2, n = wanted < left ? wanted : left;
    uint8_t packet[40];
    memcpy(packet, data + at + 2, n);
    if (n > 0) packet[0] = header(packet[0]);
    drone_take(&drone, packet, (int)n);
    answered(&drone);
    fly(&drone, data[at + 1]);
    ticks += data[at + 1];
    at += 2 + n;
  }
  if (drone.link.dropped > drone.link.in) abort();
  if (drone.finite && !isfinite((double)drone.logs.z)) abort();
  return drone_close(&drone, &why) == DONE ? 0 : -1;
}
