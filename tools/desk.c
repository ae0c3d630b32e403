// desk.c - simulated Crazyflies at the desk: clients fly them over UDP, in real time.
#define _POSIX_C_SOURCE 200809L // clock_gettime, strtok_r
#include "base/made.h"
#include "base/number.h"
#include "base/option.h"
#include "drone/drone.h"
#include "desk/datagrams.h"
#include "desk/http.h"
#include "desk/state.h"
#include "desk_usage.h"
#include "flight/request_spec.h"
#include "vehicle/model_file.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#define DRONES_MAX 10 // ports that a client scans
#define PATH_BYTES 512
#define PORT       19850
#define PAGE       8080
#define URI_BYTES  64
#define APART_M    0.5  // places on the page
#define BOOT_MS    1000 // a vehicle that answers has passed its checks and is armed
#define BATCH_MS   20   // simulated at most between two looks at the sockets
#define BEHIND_S   0.2  // farther behind than this, the time is let go

typedef struct {
  request_t request;
  model_t vehicle;
  scene_t scene;
  const char *address, *storage, *log, *scene_path;
  bool seed_said, help, version;
  double port, page, drones, speed, for_s;
  double loss, delay_s;
  made_t made, again; // again: how fly flies it anew
} order_t;

typedef struct {
  drone_t drone;
  datagrams_t radio;
  FILE *log, *commands;
  char uri[URI_BYTES];
} place_t;

// All that flies, as the page sees it.
typedef struct {
  const order_t *order;
  place_t *place;
  double behind_s;
} room_t;

static volatile sig_atomic_t ended;

static void end(int signal_number) {
  (void)signal_number;
  ended = 1;
}

// --- options

static done_t take_number(const char *option, const char *text, double min, double max, bool whole,
                          double *value, why_t *why) {
  if (number_parse(text, value) && *value >= min && *value <= max &&
      (!whole || *value == (double)(long)*value))
    return DONE;
  return error_set(why, "%s %s: allowed is a %snumber from %g to %g", option, text, whole ? "whole " : "",
                   min, max);
}

static done_t take_link(order_t *o, const char *text, why_t *why) {
  char copy[128], *rest = copy;
  if (strlen(text) >= sizeof copy) return error_set(why, "--link: allowed is loss=SHARE,delay=SECONDS");
  strcpy(copy, text);
  for (char *word; (word = strtok_r(rest, ",", &rest)) != NULL;) {
    if (strncmp(word, "loss=", 5) == 0)
      TRY(take_number("--link loss", word + 5, 0.0, 0.9, false, &o->loss, why));
    else if (strncmp(word, "delay=", 6) == 0)
      TRY(take_number("--link delay", word + 6, 0.0, 1.0, false, &o->delay_s, why));
    else
      return error_set(why, "--link %s: allowed is loss=SHARE,delay=SECONDS", word);
  }
  return DONE;
}

static done_t take_option(order_t *o, int option, const char *text, why_t *why) {
  double seed;
  switch (option) {
  case 'v': o->request.vehicle = &o->vehicle; return model_read(text, &o->vehicle, why);
  case 'e': return request_take_effect(&o->request, text, why);
  case 'n': return request_take_noise(&o->request, text, why);
  case 'd':
    TRY(take_number("--seed", text, 0.0, 1e9, true, &seed, why));
    o->request.seed = (uint64_t)seed;
    o->seed_said = true;
    return DONE;
  case 'N': return take_number("--drones", text, 1.0, DRONES_MAX, true, &o->drones, why);
  case 'p': return take_number("--port", text, 1.0, 65535.0, true, &o->port, why);
  case 'g': return take_number("--page", text, 0.0, 65535.0, true, &o->page, why);
  case 'a': o->address = text; return DONE;
  case 's': return take_number("--speed", text, 0.01, 1000.0, false, &o->speed, why);
  case 'k': return take_link(o, text, why);
  case 'S': o->storage = text; return DONE;
  case 'l': o->log = text; return DONE;
  case 'f': return take_number("--for", text, 0.0, 1e6, false, &o->for_s, why);
  case 'V': o->version = true; return DONE;
  default: o->help = true; return DONE;
  }
}

static done_t take_order(order_t *o, int argc, char **argv, why_t *why) {
  static const struct option options[] = {
      {"vehicle", 1, 0, 'v'}, {"effect", 1, 0, 'e'}, {"noise", 1, 0, 'n'},   {"seed", 1, 0, 'd'},
      {"drones", 1, 0, 'N'},  {"port", 1, 0, 'p'},   {"page", 1, 0, 'g'},    {"address", 1, 0, 'a'},
      {"speed", 1, 0, 's'},   {"link", 1, 0, 'k'},   {"storage", 1, 0, 'S'}, {"log", 1, 0, 'l'},
      {"for", 1, 0, 'f'},     {"help", 0, 0, 'h'},   {"version", 0, 0, 'V'}, {0}};
  *o = (order_t){.address = "127.0.0.1", .port = PORT, .page = PAGE, .drones = 1.0, .speed = 1.0};
  o->made = made_by("desk", argc, argv);
  o->again = (made_t){.command = NULL};
  opterr = 0;
  for (int option, at; (option = getopt_long(argc, argv, "", options, &at)) != -1;) {
    if (option == '?') return option_refuse(options, argv[optind - 1], why);
    TRY(take_option(o, option, optarg, why));
    if (strchr("ven", option)) made_option(&o->again, options[at].name, optarg);
  }
  if (o->help || o->version) return DONE;
  if (optind + 1 < argc) return error_set(why, "%s: one scene is enough", argv[optind + 1]);
  if (o->port + o->drones > 65536.0) return error_set(why, "--port, --drones: the last port is beyond 65535");
  o->scene_path = argv[optind];
  return scene_take(&o->scene, o->scene_path, &o->request, o->seed_said, why);
}

// --- places

static done_t name_file(const char *folder, int number, const char *kind, char path[PATH_BYTES], why_t *why) {
  if (snprintf(path, PATH_BYTES, "%s/%d.%s", folder, number, kind) < PATH_BYTES) return DONE;
  return error_set(why, "--log: the path is too long");
}

static done_t open_file(const char *path, FILE **file, why_t *why) {
  *file = fopen(path, "w");
  return *file ? DONE : error_set(why, "%s: %s", path, strerror(errno));
}

// What was stored before, as it is flown anew with it.
static done_t copy_storage(const char *from, const char *path, bool *copied, why_t *why) {
  FILE *const file = from ? fopen(from, "r") : NULL, *copy = NULL;
  *copied = file != NULL;
  if (!file) return DONE;
  const done_t status = open_file(path, &copy, why);
  for (int c; copy && (c = fgetc(file)) != EOF;) fputc(c, copy);
  fclose(file);
  if (copy && fclose(copy) != 0) return error_failed(why, "%s: cannot be written", path);
  return status;
}

static done_t open_log(const order_t *o, int number, uint64_t seed, place_t *place, why_t *why) {
  if (mkdir(o->log, 0777) != 0 && errno != EEXIST)
    return error_set(why, "--log %s: %s", o->log, strerror(errno));
  char log[PATH_BYTES], commands[PATH_BYTES], storage[PATH_BYTES], text[32];
  TRY(name_file(o->log, number, "csv", log, why));
  TRY(name_file(o->log, number, "commands", commands, why));
  TRY(name_file(o->log, number, "storage", storage, why));
  TRY(open_file(log, &place->log, why));
  TRY(open_file(commands, &place->commands, why));
  bool stored;
  TRY(copy_storage(number == 0 ? o->storage : NULL, storage, &stored, why));
  made_t again = made_by("out/fly", 0, NULL);
  made_option(&again, "commands", commands);
  if (o->scene_path) made_option(&again, "scene", o->scene_path);
  snprintf(text, sizeof text, "%llu", (unsigned long long)seed);
  made_option(&again, "seed", text);
  if (stored) made_option(&again, "storage", storage);
  made_words(&again, o->again.command);
  made_comment(&o->made, place->commands);
  fputs("# flown anew by: ", place->commands);
  made_line(&again, place->commands);
  fputs(" --log FILE.csv\n", place->commands);
  made_free(&again);
  return DONE;
}

static done_t open_place(const order_t *o, int number, place_t *place, why_t *why) {
  place->radio.socket = -1;
  snprintf(place->uri, sizeof place->uri, "udp://%s:%d", o->address, (int)o->port + number);
  scene_t scene = o->scene;
  scene.seed += (uint64_t)number;
  TRY(datagrams_open(&place->radio, o->address, (int)o->port + number, scene.seed, why));
  if (o->log) TRY(open_log(o, number, scene.seed, place, why));
  TRY(drone_open(&place->drone, &scene, number == 0 ? o->storage : NULL, place->log, place->commands, why));
  place->drone.params.loss = (float)o->loss;
  place->drone.params.delay = (float)o->delay_s;
  while (drone_now_ms(&place->drone) < BOOT_MS) TRY(drone_tick(&place->drone, why));
  return DONE;
}

static void close_place(place_t *place) {
  why_t why;
  if (place->drone.loop) (void)!drone_close(&place->drone, &why);
  if (place->radio.socket >= 0) datagrams_close(&place->radio);
  if (place->log) fclose(place->log);
  if (place->commands) fclose(place->commands);
}

// --- the clock

static double wall_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
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

// Up to until_ms, at most a batch.
static done_t catch_up(place_t *p, double until_ms, why_t *why) {
  for (int i = 0; i < BATCH_MS && drone_now_ms(&p->drone) + 2.0 <= until_ms; i += 2) {
    exchange(p);
    TRY(drone_tick(&p->drone, why));
  }
  exchange(p);
  return DONE;
}

// --- the page

static char *tell_page(void *context) {
  const room_t *const room = context;
  cJSON *const all = cJSON_CreateObject();
  cJSON_AddNumberToObject(all, "t_s", 1e-3 * drone_now_ms(&room->place[0].drone));
  cJSON_AddNumberToObject(all, "speed", room->order->speed);
  cJSON_AddNumberToObject(all, "behind_s", room->behind_s);
  cJSON *const drones = cJSON_AddArrayToObject(all, "drones");
  for (int i = 0; i < (int)room->order->drones; i++) {
    const place_t *const p = &room->place[i];
    const seen_as_t as = {p->uri, p->radio.has_client, APART_M * i};
    cJSON_AddItemToArray(drones, state_of(&p->drone, &as));
  }
  char *const text = cJSON_PrintUnformatted(all);
  cJSON_Delete(all);
  return text;
}

static const char *set_from_page(void *context, int drone, const char *name, double value) {
  const room_t *const room = context;
  if (drone < 0 || drone >= (int)room->order->drones) return "there is no such drone";
  static why_t why;
  return drone_set(&room->place[drone].drone, name, value, &why) == DONE ? NULL : why.text;
}

// --- flying

static done_t fly(room_t *room, http_t *http, why_t *why) {
  const order_t *const o = room->order;
  place_t *const place = room->place;
  struct pollfd fd[DRONES_MAX + 1];
  const int n = (int)o->drones;
  for (int i = 0; i < n; i++) fd[i] = (struct pollfd){.fd = place[i].radio.socket, .events = POLLIN};
  fd[n] = (struct pollfd){.fd = http ? http_fd(http) : -1, .events = POLLIN};
  double begin_s = wall_s() - 1e-3 * BOOT_MS / o->speed, at_s = 0.0;
  while (!ended && !(o->for_s > 0.0 && at_s >= o->for_s)) {
    const double now_s = wall_s();
    at_s = 1e-3 * drone_now_ms(&place[0].drone);
    const double behind_s = (now_s - begin_s) - at_s / o->speed;
    if (behind_s > BEHIND_S) begin_s += behind_s - BEHIND_S; // too slow a machine: not made up for later
    for (int i = 0; i < n; i++) {
      place[i].drone.logs.behind = (float)behind_s;
      datagrams_listen(&place[i].radio, now_s, drone_now_ms(&place[i].drone));
      if (datagrams_left(&place[i].radio, now_s)) drone_left(&place[i].drone);
      TRY(catch_up(&place[i], 1e3 * o->speed * (now_s - begin_s), why));
    }
    room->behind_s = behind_s;
    if (http) http_run(http);
    if (behind_s < 2e-3) (void)poll(fd, (nfds_t)n + 1, 1);
  }
  return DONE;
}

// --- all

static void say(const order_t *o) {
  const char *const a = o->address;
  const int port = (int)o->port;
  printf("A simulated Crazyflie with flow and multiranger decks is on at udp://%s:%d", a, port);
  if (o->drones > 1.0) printf(", others up to port %d", port + (int)o->drones - 1);
  if (o->page > 0.0) printf(", seen at http://%s:%d/", a, (int)o->page);
  printf(
      ".\nIts stock controller flies until ceil.shadow is 0 (src/firmware/README.md). Try, in another "
      "terminal:\n"
      "  cfclient                                          Scan finds it; the parameters `desk` disturb it\n"
      "  tools/cf.py --uri udp://%s:%d params set ceil.shadow=0\n"
      "  tools/cf.py --uri udp://%s:%d learn         learns the ceiling\n"
      "  tools/cf.py --uri udp://%s:%d monitor       shows what it thinks\n"
      "Ctrl-C ends it.\n",
      a, port, a, port, a, port);
  fflush(stdout);
}

static done_t run(order_t *o, place_t *place, int argc, char **argv, why_t *why) {
  TRY(take_order(o, argc, argv, why));
  if (o->help) fputs(USAGE, stdout);
  if (o->version) made_version("desk");
  if (o->help || o->version) return DONE;
  // The page first: a second start writes over no log of the first.
  room_t room = {.order = o, .place = place};
  const http_answers_t answers = {&room, tell_page, set_from_page};
  http_t *http = NULL;
  if (o->page > 0.0) TRY(http_open(&http, o->address, (int)o->page, &answers, why));
  done_t status = DONE;
  for (int i = 0; i < (int)o->drones && status == DONE; i++) status = open_place(o, i, &place[i], why);
  if (status == DONE) {
    say(o);
    status = fly(&room, http, why);
  }
  http_close(http);
  return status;
}

int main(int argc, char **argv) {
  static order_t order;
  static place_t place[DRONES_MAX];
  why_t why;
  signal(SIGINT, end);
  signal(SIGTERM, end);
  signal(SIGPIPE, SIG_IGN);
  const done_t status = run(&order, place, argc, argv, &why);
  for (int i = 0; i < DRONES_MAX; i++) close_place(&place[i]);
  made_free(&order.made);
  made_free(&order.again);
  return error_exit("desk", status, &why);
}
