// flown_anew.c - what clients sent, flown again.
#include "drone/drone.h"

#include <string.h>

#define LINE 256 // for the time and 64 bytes in hex

// The bytes of "MS HEX", 0 of "MS", else -1.
static int read_packet(const char *text, uint32_t *ms, uint8_t bytes[64]) {
  int at, n = 0;
  unsigned byte;
  if (sscanf(text, "%u %n", ms, &at) != 1) return -1;
  for (; n < 64 && sscanf(text + at, "%2x", &byte) == 1; at += 2) bytes[n++] = (uint8_t)byte;
  const bool whole = text[at] == '\n' || (text[at] == '\0' && strlen(text) < LINE - 1);
  return whole ? n : -1;
}

done_t drone_replay(drone_t *d, FILE *commands, const char *path, double more_s, why_t *why) {
  char text[LINE];
  uint32_t ms = 0, last_ms = 0;
  uint8_t bytes[64];
  d->storage.path = NULL; // nothing is stored in the file again
  for (int line = 1; fgets(text, sizeof text, commands); line++) {
    if (text[0] == '#') {
      while (!strchr(text, '\n') && fgets(text, sizeof text, commands)) continue;
      continue;
    }
    const int n = read_packet(text, &ms, bytes);
    if (n < 0 || ms < last_ms)
      return error_set(why, "%s:%d: allowed is `MS HEX`, or `MS`, in the order of time", path, line);
    last_ms = ms;
    while (drone_now_ms(d) < ms) TRY(drone_tick(d, why));
    if (n > 0)
      drone_take(d, bytes, n);
    else
      drone_left(d);
  }
  if (ferror(commands)) return error_set(why, "%s: cannot be read", path);
  for (packet_t packet; drone_now_ms(d) < ms + (uint32_t)(1e3 * more_s);) {
    TRY(drone_tick(d, why));
    while (link_give(&d->link, &packet)) continue;
  }
  return DONE;
}
