// test_place.c - one vehicle at the desk: its files are whole, or it says so.
#define _DEFAULT_SOURCE // symlink
#include "desk/place.h"

#include "rig/scratch.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/socket.h>
#include <unistd.h>

typedef struct {
  scene_t scene;
  made_t made, again;
  place_order_t order;
  char folder[200];
  place_t place;
} rig_t;

static rig_t *rig(const char *name) {
  static char *words[] = {"desk"};
  rig_t *const r = calloc(1, sizeof *r);
  why_t why;
  CHECK_OK(scene_default(&r->scene, &why));
  r->made = made_by("desk", 1, words);
  r->again = (made_t){.command = NULL};
  snprintf(r->folder, sizeof r->folder, "%s", scratch_path(name));
  r->order = (place_order_t){.scene = &r->scene,
                             .address = {htonl(INADDR_LOOPBACK)},
                             .log = r->folder,
                             .made = &r->made,
                             .again = &r->again};
  return r;
}

static void end(rig_t *r) {
  made_free(&r->made);
  made_free(&r->again);
  free(r);
}

static char *text_of(const char *folder, const char *name) {
  char file[100];
  snprintf(file, sizeof file, "%s/%s", folder, name);
  return scratch_text(file);
}

// Of a second's flight, in which a client asks for an echo.
static void fly(rig_t *r) {
  why_t why;
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  const struct sockaddr_in to = {.sin_family = AF_INET,
                                 .sin_port = htons((uint16_t)r->place.radio.port),
                                 .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  CHECK(sendto(fd, "\xfd", 2, 0, (const struct sockaddr *)&to, sizeof to) == 2);
  for (int ms = 1000; ms <= 2000; ms += 20) CHECK_OK(place_fly(&r->place, 1e-3 * ms, 1e-3 * ms, &why));
  uint8_t answer[40];
  CHECK(recv(fd, answer, sizeof answer, MSG_DONTWAIT) == 31);
  close(fd);
}

TEST(place_writes_whole_logs_and_what_came_over_the_link) {
  rig_t *const r = rig("place_logs");
  why_t why;
  if (CHECK_OK(place_open(&r->place, &r->order, 0, &why))) {
    char *early = text_of("place_logs", "0.commands");
    fly(r);
    CHECK_OK(place_flush(&r->place, &why));
    char *const flushed = text_of("place_logs", "0.commands");
    CHECK(strlen(flushed) > strlen(early));
    CHECK(strstr(flushed, "\n1000 fd00\n") != NULL);
    CHECK_OK(place_close(&r->place, &why));
    char *const log = text_of("place_logs", "0.csv");
    int rows = -1; // the names
    for (const char *at = log; (at = strchr(at, '\n')) != NULL; at++) rows++;
    CHECK_NEAR(rows, 200, 1); // 100 a second
    free(log);
    free(flushed);
    free(early);
  }
  end(r);
}

TEST(place_says_which_file_could_not_be_written) {
  if (access("/dev/full", W_OK) != 0) SKIP("no /dev/full");
  static const char *const name[] = {"0.commands", "0.csv", "0.storage"};
  for (unsigned i = 0; i < sizeof name / sizeof *name; i++) {
    ROW("%s", name[i]);
    char folder[30], file[260], want[320], storage[260];
    snprintf(folder, sizeof folder, "place_full_%u", i);
    rig_t *const r = rig(folder);
    CHECK(mkdir(r->folder, 0777) == 0);
    snprintf(file, sizeof file, "%s/%s", r->folder, name[i]);
    CHECK(symlink("/dev/full", file) == 0);
    snprintf(storage, sizeof storage, "%s", scratch_file("place_storage", "indiPos.kpz = 1.4\n", -1));
    r->order.storage = storage;
    snprintf(want, sizeof want, "%s: cannot be written: it is not whole", file);
    why_t why = {""};
    done_t status = place_open(&r->place, &r->order, 0, &why);
    if (status == DONE) {
      fly(r);
      status = place_close(&r->place, &why);
    }
    CHECK_STATUS(FAILED, status);
    CHECK_TEXT(why.text, want);
    end(r);
  }
}

TEST(place_that_cannot_be_opened_leaves_nothing_open) {
  const int before = dup(0);
  close(before);
  rig_t *const r = rig("place_beyond");
  r->order.log = "/nowhere/at/all";
  why_t why;
  CHECK_STATUS(BAD_INPUT, place_open(&r->place, &r->order, 0, &why));
  r->order.address.s_addr = htonl(0xc0000201u);
  CHECK_STATUS(BAD_INPUT, place_open(&r->place, &r->order, 0, &why));
  const int after = dup(0);
  CHECK_NEAR(after, before, 0); // the lowest number that is free, and the standard input still there
  close(after);
  end(r);
}
