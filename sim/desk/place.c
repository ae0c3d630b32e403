// place.c - one vehicle at the desk.
#include "desk/place.h"

#include "desk/address.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define BATCH_MS 20 // simulated at most between two looks at the sockets

// Files: the flight, what came over the link, and what was stored before.

static done_t name_file(const char *folder, int number, const char *kind, char path[PLACE_PATH], why_t *why) {
  if (snprintf(path, PLACE_PATH, "%s/%d.%s", folder, number, kind) < PLACE_PATH) return DONE;
  return error_set(why, "--log: the path is too long");
}

static done_t open_file(const char *path, FILE **file, why_t *why) {
  *file = fopen(path, "w");
  return *file ? DONE : error_set(why, "%s: %s", path, strerror(errno));
}

static done_t not_whole(const char *path, why_t *why) {
  return error_failed(why, "%s: cannot be written: it is not whole", path);
}

static done_t close_file(FILE **file, const char *path, why_t *why) {
  if (!*file) return DONE;
  const bool spoilt = ferror(*file) != 0, closed = fclose(*file) == 0;
  *file = NULL;
  return closed && !spoilt ? DONE : not_whole(path, why);
}

// Copies what was stored before, to fly it anew with.
static done_t copy_storage(const char *from, const char *path, bool *copied, why_t *why) {
  FILE *const file = from ? fopen(from, "r") : NULL, *copy = NULL;
  *copied = file != NULL;
  if (!file) return DONE;
  const done_t status = open_file(path, &copy, why);
  for (int c; copy && (c = fgetc(file)) != EOF;) fputc(c, copy);
  fclose(file);
  TRY(status);
  return close_file(&copy, path, why);
}

// Heads the commands by how fly flies them.
static void say_again(const place_t *p, const place_order_t *o, uint64_t seed, const char *storage) {
  char text[32];
  made_t again = made_by("out/fly", 0, NULL);
  made_option(&again, "commands", p->commands_path);
  if (o->scene_path) made_option(&again, "scene", o->scene_path);
  snprintf(text, sizeof text, "%llu", (unsigned long long)seed);
  made_option(&again, "seed", text);
  if (storage) made_option(&again, "storage", storage);
  made_words(&again, o->again->command);
  made_comment(o->made, p->commands);
  fputs("# flown anew by: ", p->commands);
  made_line(&again, p->commands);
  fputs(" --log FILE.csv\n", p->commands);
  made_free(&again);
}

static done_t open_files(place_t *p, const place_order_t *o, int number, uint64_t seed, why_t *why) {
  if (mkdir(o->log, 0777) != 0 && errno != EEXIST)
    return error_set(why, "--log %s: %s", o->log, strerror(errno));
  char storage[PLACE_PATH];
  TRY(name_file(o->log, number, "csv", p->log_path, why));
  TRY(name_file(o->log, number, "commands", p->commands_path, why));
  TRY(name_file(o->log, number, "storage", storage, why));
  TRY(open_file(p->log_path, &p->log, why));
  TRY(open_file(p->commands_path, &p->commands, why));
  bool stored;
  TRY(copy_storage(number == 0 ? o->storage : NULL, storage, &stored, why));
  say_again(p, o, seed, stored ? storage : NULL);
  return DONE;
}

done_t place_flush(place_t *p, why_t *why) {
  if (p->log && (fflush(p->log) != 0 || ferror(p->log))) return not_whole(p->log_path, why);
  if (p->commands && (fflush(p->commands) != 0 || ferror(p->commands)))
    return not_whole(p->commands_path, why);
  return DONE;
}

static done_t tick(place_t *p, why_t *why) {
  const done_t status = drone_tick(&p->drone, why);
  if (status != DONE) TRY(place_flush(p, why)); // names the file, if one failed
  return status;
}

static done_t open_all(place_t *p, const place_order_t *o, int number, why_t *why) {
  char near[ADDRESS_TEXT];
  scene_t scene = *o->scene;
  scene.seed += (uint64_t)number;
  TRY(datagrams_open(&p->radio, o->address, o->port ? o->port + number : 0, scene.seed, why));
  snprintf(p->uri, sizeof p->uri, "udp://%s:%d", address_near(o->address, near), p->radio.port);
  if (o->log) TRY(open_files(p, o, number, scene.seed, why));
  TRY(drone_open(&p->drone, &scene, number == 0 ? o->storage : NULL, p->log, p->commands, why));
  while (drone_now_ms(&p->drone) < PLACE_BOOT_MS) TRY(tick(p, why));
  return DONE;
}

done_t place_open(place_t *p, const place_order_t *o, int number, why_t *why) {
  memset(p, 0, sizeof *p);
  p->radio.socket = -1;
  const done_t status = open_all(p, o, number, why);
  why_t later; // the first error is the cause
  if (status != DONE) (void)!place_close(p, &later);
  return status;
}

done_t place_close(place_t *p, why_t *why) {
  why_t later;
  const done_t flown = p->drone.loop ? drone_close(&p->drone, why) : DONE;
  datagrams_close(&p->radio);
  // Their errors name the file: they come first.
  const done_t log = close_file(&p->log, p->log_path, why);
  const done_t commands = close_file(&p->commands, p->commands_path, log == DONE ? why : &later);
  return log != DONE ? log : commands != DONE ? commands : flown;
}

static void exchange(place_t *p) {
  const uint32_t now_ms = drone_now_ms(&p->drone);
  uint8_t bytes[DATAGRAMS_BYTES];
  p->radio.loss = (double)p->drone.params.loss;
  p->radio.delay_s = (double)p->drone.params.delay;
  for (int n; (n = datagrams_receive(&p->radio, now_ms, bytes)) > 0;) drone_take(&p->drone, bytes, n);
  for (packet_t packet; link_give(&p->drone.link, &packet);) datagrams_send(&p->radio, &packet, now_ms);
  datagrams_flush(&p->radio, now_ms);
}

done_t place_fly(place_t *p, double wall_s, double until_s, why_t *why) {
  datagrams_listen(&p->radio, wall_s, drone_now_ms(&p->drone));
  if (datagrams_left(&p->radio, wall_s)) drone_left(&p->drone);
  for (int i = 0; i < BATCH_MS && drone_now_ms(&p->drone) + 2.0 <= 1e3 * until_s; i += 2) {
    exchange(p);
    TRY(tick(p, why));
  }
  exchange(p);
  return DONE;
}
