// usd_deck.c - what the uSD deck writes.
#include "usd_deck.h"

#include "log.h"
#include <math.h>
#include <string.h>
#include <zlib.h>

#define MAGIC    0xBC
#define VERSION  2
#define FIXED_ID 0xFFFF
#define COPY_US  20 // about what a row of 100 bytes takes, copied one by one

static void put(usd_deck_t *d, const void *bytes, size_t n) {
  d->crc = crc32(d->crc, bytes, (uInt)n);
  (void)fwrite(bytes, 1, n, d->to); // an error shows when the file is closed
}

static void put_number(usd_deck_t *d, uint64_t value, size_t n) {
  unsigned char byte[8];
  for (size_t i = 0; i < n; i++) byte[i] = (unsigned char)(value >> (8 * i));
  put(d, byte, n);
}

static void put_text(usd_deck_t *d, const char *text, size_t n) {
  put(d, text, n);
}

static size_t size_of(const section_log_t *log) {
  return log->type == LOG_UINT8 ? 1 : 4;
}

static const char *letter_of(const section_log_t *log) {
  return log->type == LOG_UINT8 ? "(B)" : log->type == LOG_UINT32 ? "(I)" : "(f)";
}

static unsigned id_of(const usd_deck_t *d, int event) {
  return strcmp(d->config.event[event].name, "fixedFrequency") == 0 ? FIXED_ID : (unsigned)event;
}

static void put_head(usd_deck_t *d) {
  const usd_config_t *const c = &d->config;
  put_number(d, MAGIC, 1);
  put_number(d, VERSION, 2);
  put_number(d, (uint64_t)c->n, 2);
  for (int i = 0; i < c->n; i++) {
    put_number(d, id_of(d, i), 2);
    put_text(d, c->event[i].name, strlen(c->event[i].name) + 1);
    put_number(d, (uint64_t)c->event[i].n, 2);
    for (int k = 0; k < c->event[i].n; k++) {
      put_text(d, c->event[i].variable[k], strlen(c->event[i].variable[k]));
      put_text(d, letter_of(d->log[i][k]), 4);
    }
  }
}

static bool busy(const usd_card_t *card, double t_s) {
  return card->busy_every_s > 0.0 && fmod(t_s, card->busy_every_s) < card->busy_s;
}

static bool has_room(usd_deck_t *d, uint64_t now_us, size_t bytes) {
  if (!(d->card.speed_Bps > 0.0)) return true;
  const double since_s = 1e-6 * (double)(now_us - d->last_us);
  d->last_us = now_us;
  if (!busy(&d->card, 1e-6 * (double)now_us))
    d->waiting = fmax(d->waiting - since_s * d->card.speed_Bps, 0.0);
  if (d->waiting + (double)bytes > (double)d->config.buffer_bytes) return false;
  d->waiting += (double)bytes;
  return true;
}

static void put_row(usd_deck_t *d, int event) {
  const usd_config_event_t *const e = &d->config.event[event];
  size_t bytes = 10;
  for (int k = 0; k < e->n; k++) bytes += size_of(d->log[event][k]);
  const uint64_t now_us = 1000 * (uint64_t)d->vehicle->app.in.step + COPY_US * (uint64_t)event;
  d->asked++;
  if (!has_room(d, now_us, bytes)) return;
  put_number(d, id_of(d, event), 2);
  put_number(d, now_us, 8);
  for (int k = 0; k < e->n; k++) {
    const section_log_t *const log = d->log[event][k];
    put(d, crazyflie_at(d->vehicle, log->address), size_of(log));
  }
  d->written++;
}

static void on_event(void *deck, const char *name) {
  usd_deck_t *const d = deck;
  for (int i = 0; i < d->config.n; i++)
    if (strcmp(d->config.event[i].name, name) == 0) put_row(d, i);
}

done_t usd_deck_init(usd_deck_t *d, const char *config_path, FILE *to, why_t *why) {
  *d = (usd_deck_t){.to = to, .crc = crc32(0, NULL, 0)};
  TRY(usd_config_read(config_path, &d->config, why));
  TRY(usd_config_check(config_path, &d->config, why));
  for (int i = 0; i < d->config.n; i++)
    for (int k = 0; k < d->config.event[i].n; k++)
      d->log[i][k] = sections_log(d->config.event[i].variable[k]);
  put_head(d);
  return DONE;
}

void usd_deck_start(usd_deck_t *d, crazyflie_t *vehicle) {
  if (d->flights++ > 0) return;
  d->vehicle = vehicle;
  vehicle->around.event = on_event;
  vehicle->around.event_context = d;
}

void usd_deck_stop(usd_deck_t *d) {
  const unsigned long crc = d->crc;
  put_number(d, crc, 4);
}
