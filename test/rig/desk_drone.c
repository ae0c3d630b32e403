// desk_drone.c - a simulated drone of the desk for tests, and its client in simulated time.
#include "rig/desk_drone.h"

#include "crazyflie/values.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

drone_t *desk_drone(double ceiling_m, FILE *log, FILE *commands) {
  drone_t *const d = calloc(1, sizeof *d);
  scene_t scene;
  why_t why;
  CHECK_OK(scene_default(&scene, &why));
  scene.setup.model.ceiling_m = ceiling_m;
  CHECK_OK(drone_open(d, &scene, NULL, log, commands, &why));
  return d;
}

drone_t *desk_drone_in(const char *scene_text) {
  drone_t *const d = calloc(1, sizeof *d);
  scene_t scene;
  why_t why;
  CHECK_OK(scene_default(&scene, &why));
  CHECK_OK(scene_read(scratch_file("scene.toml", scene_text, -1), &scene, &why));
  CHECK_OK(drone_open(d, &scene, NULL, NULL, NULL, &why));
  return d;
}

void desk_end(drone_t *d) {
  why_t why;
  CHECK_OK(drone_close(d, &why));
  free(d);
}

void desk_pass(drone_t *d, double s) {
  why_t why;
  packet_t packet;
  for (const uint32_t until_ms = drone_now_ms(d) + (uint32_t)(1e3 * s); drone_now_ms(d) < until_ms;) {
    CHECK_OK(drone_tick(d, &why));
    while (link_give(&d->link, &packet)) continue;
  }
}

void desk_set(drone_t *d, const char *name, double value) {
  const int i = firmware_param_find(&d->firmware, name);
  uint8_t packet[7] = {0x2e, (uint8_t)i, (uint8_t)(i >> 8)};
  const int type = firmware_param_row(&d->firmware, i).type;
  CHECK(i >= 0);
  values_put(type, packet + 3, value);
  drone_take(d, packet, 3 + link_param_bytes(type));
}

void desk_climb(drone_t *d, float height_m) {
  const float two_s = 2.0f;
  uint8_t packet[16] = {0x8c, 7};
  memcpy(packet + 3, &height_m, 4);
  packet[11] = 1;
  memcpy(packet + 12, &two_s, 4);
  drone_take(d, packet, sizeof packet);
}

void desk_land(drone_t *d) {
  uint8_t packet[16] = {0x8c, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0x40};
  drone_take(d, packet, sizeof packet);
}

double desk_log(drone_t *d, const char *name) {
  firmware_look(&d->firmware);
  return firmware_log(&d->firmware, firmware_log_find(&d->firmware, name));
}
