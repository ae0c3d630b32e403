// desk.c - simulated Crazyflies at the desk: clients fly them over UDP, in real time.
#define _POSIX_C_SOURCE 200809L // sigaction, strtok_r
#include "base/made.h"
#include "base/number.h"
#include "base/option.h"
#include "desk/address.h"
#include "desk/http.h"
#include "desk/pace.h"
#include "desk/place.h"
#include "desk/state.h"
#include "desk_usage.h"
#include "flight/request_spec.h"
#include "vehicle/model_file.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#define DRONES_MAX 10 // a client scans so many ports
#define PORT       19850
#define PAGE       8080
#define APART_M    0.5 // distance of the drones on the page
#define FLUSH_S    1.0 // a crash loses at most so much of the logs

typedef struct {
  request_t request;
  model_t vehicle;
  scene_t scene;
  place_order_t places;
  bool seed_said, help, version;
  double port, page, drones, speed, for_s, loss, delay_s;
  made_t made, again; // again: the command with which fly repeats it
} order_t;

// All drones, as the page sees them.
typedef struct {
  const order_t *order;
  place_t *place;
  int n;
  pace_t pace;
} room_t;

static volatile sig_atomic_t ended;

static void end(int signal_number) {
  (void)signal_number;
  ended = 1;
}

// typed: the whole word, for the message.
static done_t take_of(const char *option, const char *typed, const char *number, double min, double max,
                      bool whole, double *value, why_t *why) {
  char shown[NUMBER_SHOWN];
  if (number_parse(number, value) && *value >= min && *value <= max &&
      (!whole || *value == (double)(long)*value))
    return DONE;
  return error_set(why, "%s %s: allowed is a %snumber from %g to %g", option, number_shown(typed, shown),
                   whole ? "whole " : "", min, max);
}

static done_t take_number(const char *option, const char *text, double min, double max, bool whole,
                          double *value, why_t *why) {
  return take_of(option, text, text, min, max, whole, value, why);
}

static done_t take_link(order_t *o, const char *text, why_t *why) {
  char copy[128], shown[NUMBER_SHOWN], *rest = copy;
  if (text[strspn(text, ",")] == '\0' || strlen(text) >= sizeof copy)
    return error_set(why, "--link: allowed is loss=SHARE,delay=SECONDS");
  strcpy(copy, text);
  for (char *word; (word = strtok_r(rest, ",", &rest)) != NULL;) {
    if (strncmp(word, "loss=", 5) == 0)
      TRY(take_of("--link", word, word + 5, 0.0, 0.9, false, &o->loss, why));
    else if (strncmp(word, "delay=", 6) == 0)
      TRY(take_of("--link", word, word + 6, 0.0, 1.0, false, &o->delay_s, why));
    else
      return error_set(why, "--link %s: allowed is loss=SHARE,delay=SECONDS", number_shown(word, shown));
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
  case 'a': return address_parse(text, &o->places.address, why);
  case 's': return take_number("--speed", text, 0.01, 1000.0, false, &o->speed, why);
  case 'k': return take_link(o, text, why);
  case 'S': o->places.storage = text; return DONE;
  case 'l': o->places.log = text; return DONE;
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
  *o = (order_t){.port = PORT, .page = PAGE, .drones = 1.0, .speed = 1.0};
  o->places.address.s_addr = htonl(INADDR_LOOPBACK);
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
  o->places.scene = &o->scene;
  o->places.scene_path = argv[optind];
  o->places.made = &o->made;
  o->places.again = &o->again;
  o->places.port = (int)o->port;
  TRY(scene_take(&o->scene, argv[optind], &o->request, o->seed_said, why));
  o->scene.loss = o->loss;
  o->scene.delay_s = o->delay_s;
  return DONE;
}

static char *tell_page(void *context) {
  const room_t *const room = context;
  cJSON *const all = cJSON_CreateObject();
  cJSON_AddNumberToObject(all, "t_s", 1e-3 * drone_now_ms(&room->place[0].drone));
  cJSON_AddNumberToObject(all, "speed", room->order->speed);
  cJSON_AddNumberToObject(all, "behind_s", room->pace.behind_s);
  cJSON *const drones = cJSON_AddArrayToObject(all, "drones");
  for (int i = 0; i < room->n; i++) {
    const place_t *const p = &room->place[i];
    const seen_as_t as = {p->uri, &p->radio, APART_M * i};
    cJSON_AddItemToArray(drones, state_of(&p->drone, &as));
  }
  char *const text = cJSON_PrintUnformatted(all);
  cJSON_Delete(all);
  return text;
}

static const char *set_from_page(void *context, int drone, const char *name, double value) {
  const room_t *const room = context;
  if (drone < 0 || drone >= room->n) return "there is no such drone";
  static why_t why; // good until the next call
  return drone_set(&room->place[drone].drone, name, value, &why) == DONE ? NULL : why.text;
}

static done_t flush(room_t *room, double wall_s, double *flushed_s, why_t *why) {
  if (wall_s - *flushed_s < FLUSH_S) return DONE;
  *flushed_s = wall_s;
  for (int i = 0; i < room->n; i++) TRY(place_flush(&room->place[i], why));
  return DONE;
}

static done_t fly(room_t *room, http_t *http, why_t *why) {
  place_t *const place = room->place;
  const double for_s = room->order->for_s;
  struct pollfd fd[DRONES_MAX + 1];
  for (int i = 0; i < room->n; i++) fd[i] = (struct pollfd){.fd = place[i].radio.socket, .events = POLLIN};
  fd[room->n] = (struct pollfd){.fd = http ? http_fd(http) : -1, .events = POLLIN};
  double at_s = 1e-3 * drone_now_ms(&place[0].drone), flushed_s = pace_wall_s();
  room->pace = pace_begin(room->order->speed, flushed_s, at_s);
  while (!ended && !(for_s > 0.0 && at_s >= for_s)) {
    const double wall_s = pace_wall_s(), until_s = pace_until_s(&room->pace, wall_s, at_s);
    for (int i = 0; i < room->n; i++) {
      place[i].drone.logs.behind = (float)room->pace.behind_s;
      TRY(place_fly(&place[i], wall_s, until_s, why));
    }
    at_s = 1e-3 * drone_now_ms(&place[0].drone);
    TRY(flush(room, wall_s, &flushed_s, why));
    if (http) http_run(http);
    if (room->pace.behind_s < 2e-3) (void)poll(fd, (nfds_t)room->n + 1, 1);
  }
  return DONE;
}

static void say(const order_t *o, const char *uri) {
  char near[ADDRESS_TEXT];
  address_near(o->places.address, near);
  printf("A simulated Crazyflie with flow and multiranger decks is on at %s", uri);
  if (o->drones > 1.0) printf(", others up to port %d", (int)(o->port + o->drones) - 1);
  if (o->page > 0.0) printf(", seen at http://%s:%d/", near, (int)o->page);
  puts(".");
  if (address_is_every(o->places.address))
    printf("Another machine types this one's own address in place of %s.\n", near);
  printf("Its stock controller flies until ceil.shadow is 0 (src/firmware/README.md). Try, in another "
         "terminal:\n"
         "  make setup-cf                                # first: the stock library, into out/cf; a minute\n"
         "  out/cf/bin/python tools/cf/hop.py %s   # takes off, goes 30 cm, lands\n"
         "  out/cf/bin/python tools/cf.py --uri %s params set ceil.shadow=0\n"
         "  out/cf/bin/python tools/cf.py --uri %s learn   # the ceiling; 90 s\n"
         "  cfclient                                     # pip install cfclient; Scan finds it, and its\n"
         "                                               # parameters `desk` disturb it\n"
         "Ctrl-C ends it.\n",
         uri, uri, uri);
  fflush(stdout);
}

static done_t open_places(room_t *room, why_t *why) {
  for (; room->n < (int)room->order->drones; room->n++)
    TRY(place_open(&room->place[room->n], &room->order->places, room->n, why));
  return DONE;
}

// Reports what went wrong first.
static done_t close_places(room_t *room, done_t status, why_t *why) {
  for (int i = 0; i < room->n; i++) {
    why_t later;
    const done_t closed = place_close(&room->place[i], status == DONE ? why : &later);
    if (status == DONE) status = closed;
  }
  return status;
}

static done_t run(order_t *o, place_t *place, int argc, char **argv, why_t *why) {
  TRY(take_order(o, argc, argv, why));
  if (o->help) fputs(USAGE, stdout);
  if (o->version) made_version("desk");
  if (o->help || o->version) return DONE;
  // Opens the page first, so that a second desk fails before it overwrites logs of the first.
  room_t room = {.order = o, .place = place};
  const http_answers_t answers = {&room, tell_page, set_from_page};
  http_t *http = NULL;
  if (o->page > 0.0) TRY(http_open(&http, o->places.address, (int)o->page, &answers, why));
  done_t status = open_places(&room, why);
  if (status == DONE) {
    say(o, place[0].uri);
    status = fly(&room, http, why);
  }
  http_close(http);
  return close_places(&room, status, why);
}

// No SA_RESTART, so that a call that waits is ended. If hang-ups are ignored (nohup), they stay so.
static void hear(int signal_number) {
  const struct sigaction ends = {.sa_handler = end};
  struct sigaction was;
  if (sigaction(signal_number, NULL, &was) == 0 && (signal_number != SIGHUP || was.sa_handler != SIG_IGN))
    sigaction(signal_number, &ends, NULL);
}

int main(int argc, char **argv) {
  static order_t order;
  static place_t place[DRONES_MAX];
  why_t why;
  hear(SIGINT);
  hear(SIGTERM);
  hear(SIGHUP);
  signal(SIGPIPE, SIG_IGN);
  const done_t status = run(&order, place, argc, argv, &why);
  made_free(&order.made);
  made_free(&order.again);
  return error_exit("desk", status, &why);
}
