// test_datagrams.c - the air between a vehicle and its clients, through sockets of the same process; the
// clocks are the test's own.
#include "desk/datagrams.h"
#include "rig/test.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static const struct in_addr every = {0};
static const uint8_t begins[] = {0xfd, 0}, scans[] = {0xff}, asks[] = {0xfc, 7}, other_source[] = {0xfd, 1};

static struct in_addr loopback(void) {
  return (struct in_addr){htonl(INADDR_LOOPBACK)};
}

static bool opened(datagrams_t *r, uint64_t seed) {
  why_t why;
  return CHECK_OK(datagrams_open(r, loopback(), 0, seed, &why));
}

// A client's socket, with a port of its own.
static int dial(const datagrams_t *r) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  const struct sockaddr_in to = {
      .sin_family = AF_INET, .sin_port = htons((uint16_t)r->port), .sin_addr = loopback()};
  CHECK(connect(fd, (const struct sockaddr *)&to, sizeof to) == 0);
  return fd;
}

static void say(int fd, const uint8_t *bytes, size_t n) {
  CHECK(send(fd, bytes, n, 0) == (ssize_t)n);
}

// What a client hears next; -1: nothing.
static int heard(int fd) {
  uint8_t byte[DATAGRAMS_BYTES];
  const ssize_t n = recv(fd, byte, sizeof byte, 0);
  return n > 0 ? byte[n - 1] : -1;
}

static void tell(datagrams_t *r, uint8_t number, uint32_t now_ms) {
  const packet_t packet = {.size = 2, .byte = {0x5e, number}};
  datagrams_send(r, &packet, now_ms);
}

// The numbers of all packets that are through now, and how many.
static int through(datagrams_t *r, uint32_t now_ms, int *number, int most) {
  uint8_t bytes[DATAGRAMS_BYTES];
  int n = 0;
  for (int size; n < most && (size = datagrams_receive(r, now_ms, bytes)) > 0;) number[n++] = bytes[size - 1];
  return n;
}

static const uint8_t much[200] = {0xfd};
static const struct {
  const char *what;
  const uint8_t *bytes;
  size_t size;
  bool takes;
  int answer;
  uint32_t dropped;
} stray[] = {
    {"an empty one", begins, 0, false, -1, 1},
    {"a scan", scans, 1, false, 0xff, 0},
    {"an echo", asks, 2, false, -1, 1},
    {"another request of the source's port", other_source, 2, false, -1, 1},
    {"the request without its 0", begins, 1, false, -1, 1},
    {"one that is too long", much, sizeof much, false, -1, 1},
    {"what a session begins with", begins, 2, true, -1, 0},
};

TEST(datagrams_a_client_stays_whatever_comes_from_elsewhere) {
  for (unsigned i = 0; i < sizeof stray / sizeof *stray; i++) {
    ROW("%s", stray[i].what);
    datagrams_t r;
    int got[4];
    if (!opened(&r, 1)) return;
    const int first = dial(&r), second = dial(&r);
    say(first, begins, sizeof begins);
    datagrams_listen(&r, 0.0, 0);
    CHECK_NEAR(through(&r, 0, got, 4), 1, 0);
    CHECK(!datagrams_left(&r, 0.0));

    say(second, stray[i].bytes, stray[i].size);
    datagrams_listen(&r, 0.1, 100);
    CHECK(datagrams_left(&r, 0.1) == stray[i].takes);
    CHECK(!datagrams_left(&r, 0.1));
    CHECK_NEAR(through(&r, 100, got, 4), stray[i].takes, 0);
    CHECK_NEAR(r.dropped, stray[i].dropped, 0);
    CHECK_NEAR(heard(second), stray[i].answer, 0);
    tell(&r, 9, 100);
    CHECK_NEAR(heard(first), stray[i].takes ? -1 : 9, 0);
    CHECK_NEAR(heard(second), stray[i].takes ? 9 : -1, 0);
    close(first);
    close(second);
    datagrams_close(&r);
  }
}

TEST(datagrams_a_client_that_is_silent_has_gone_and_any_packet_begins_then) {
  datagrams_t r;
  int got[4];
  if (!opened(&r, 1)) return;
  const int first = dial(&r), second = dial(&r);
  say(first, scans, sizeof scans);
  datagrams_listen(&r, 0.0, 0);
  CHECK(!r.has_client && heard(first) == 0xff);
  say(first, asks, sizeof asks);
  datagrams_listen(&r, 1.0, 0);
  CHECK(r.has_client && !datagrams_left(&r, 1.0 + 0.99 * DATAGRAMS_SILENT_S));
  CHECK(datagrams_left(&r, 1.0 + DATAGRAMS_SILENT_S) && !r.has_client);
  CHECK(!datagrams_left(&r, 2.0 + DATAGRAMS_SILENT_S));
  CHECK_NEAR(through(&r, 0, got, 4), 1, 0);
  say(second, asks, sizeof asks);
  datagrams_listen(&r, 6.0, 0);
  CHECK(r.has_client && !datagrams_left(&r, 6.0)); // who was silent has left already
  CHECK_NEAR(through(&r, 0, got, 4), 1, 0);
  tell(&r, 3, 0);
  CHECK_NEAR(heard(second), 3, 0);
  CHECK_NEAR(heard(first), -1, 0);
  close(first);
  close(second);
  datagrams_close(&r);
}

TEST(datagrams_under_way_to_a_client_never_reach_the_next) {
  datagrams_t r;
  int got[4];
  if (!opened(&r, 1)) return;
  r.delay_s = 0.1;
  const int first = dial(&r), second = dial(&r);
  say(first, begins, sizeof begins);
  say(first, asks, sizeof asks);
  datagrams_listen(&r, 0.0, 0);
  tell(&r, 4, 0);
  say(second, begins, sizeof begins);
  datagrams_listen(&r, 0.0, 0);
  CHECK_NEAR(r.lost, 3, 0);
  CHECK_NEAR(through(&r, 1000, got, 4), 1, 0);
  datagrams_flush(&r, 1000);
  CHECK_NEAR(heard(second), -1, 0);
  close(first);
  close(second);
  datagrams_close(&r);
}

#define SENT 5000

// Which of so many sent packets came, by their order.
static int lost_of(uint64_t seed, double loss, bool came[SENT]) {
  datagrams_t r;
  int got[1], n = 0;
  memset(came, 0, SENT * sizeof *came);
  if (!opened(&r, seed)) return -1;
  const int fd = dial(&r);
  r.loss = loss;
  for (int i = 0; i < SENT; i++) {
    say(fd, asks, sizeof asks);
    datagrams_listen(&r, 0.0, 0);
    came[i] = through(&r, 0, got, 1) == 1;
    n += !came[i];
  }
  CHECK_NEAR(r.lost, n, 0);
  close(fd);
  datagrams_close(&r);
  return n;
}

TEST(datagrams_are_lost_by_the_share_that_is_asked_for_and_by_the_seed) {
  static const double loss[] = {0.0, 0.05, 0.5};
  static bool came[SENT], again[SENT], other[SENT];
  for (unsigned i = 0; i < sizeof loss / sizeof *loss; i++) {
    ROW("loss %g", loss[i]);
    // Four standard deviations of a count.
    CHECK_NEAR(lost_of(1, loss[i], came), SENT * loss[i], 4.0 * sqrt(SENT * loss[i] * (1.0 - loss[i])));
    (void)lost_of(1, loss[i], again);
    CHECK(memcmp(came, again, sizeof came) == 0);
    (void)lost_of(2, loss[i], other);
    CHECK((memcmp(came, other, sizeof came) != 0) == (loss[i] > 0.0));
  }
}

TEST(datagrams_are_delayed_by_half_to_one_and_a_half_times_and_change_their_order) {
  enum { N = 200 };
  datagrams_t r;
  int got[N], n = 0, swapped = 0;
  double sum_ms = 0.0;
  if (!opened(&r, 1)) return;
  const int fd = dial(&r);
  r.delay_s = 0.02;
  for (uint32_t ms = 0; ms < N + 30; ms++) {
    const uint8_t packet[] = {0xfc, (uint8_t)ms};
    if (ms < N) say(fd, packet, sizeof packet);
    datagrams_listen(&r, 0.0, ms);
    for (int k = through(&r, ms, got + n, N - n), last = n + k; n < last; n++) {
      const int waited_ms = (int)ms - got[n];
      CHECK(waited_ms >= 10 && waited_ms <= 30);
      sum_ms += waited_ms;
      swapped += n > 0 && got[n] < got[n - 1];
    }
  }
  CHECK_NEAR(n, N, 0);
  // The mean of N even ones, cut to whole milliseconds; four standard deviations.
  CHECK_NEAR(sum_ms / N, 19.5, 4.0 * 20.0 / sqrt(12.0 * N));
  CHECK(swapped > 0);
  close(fd);
  datagrams_close(&r);
}

TEST(datagrams_without_a_delay_keep_their_order_both_ways) {
  datagrams_t r;
  int got[40];
  if (!opened(&r, 1)) return;
  const int fd = dial(&r);
  for (uint8_t i = 0; i < 40; i++) say(fd, (const uint8_t[]){0xfc, i}, 2);
  datagrams_listen(&r, 0.0, 0);
  CHECK_NEAR(through(&r, 0, got, 40), 40, 0);
  for (int i = 0; i < 40; i++) CHECK_NEAR(got[i], i, 0);
  for (uint8_t i = 0; i < 40; i++) tell(&r, i, 0);
  for (int i = 0; i < 40; i++) CHECK_NEAR(heard(fd), i, 0);
  close(fd);
  datagrams_close(&r);
}

TEST(datagrams_say_in_one_line_why_nothing_can_listen) {
  datagrams_t first, second;
  if (!opened(&first, 1)) return;
  char in_use[100], in_use_for_all[100];
  snprintf(in_use, sizeof in_use, "127.0.0.1:%d: in use; another --port, or is it running already?",
           first.port);
  snprintf(in_use_for_all, sizeof in_use_for_all,
           "0.0.0.0:%d: in use; another --port, or is it running already?", first.port);
  const struct {
    const char *what;
    struct in_addr address;
    const char *line;
  } row[] = {
      {"in use", loopback(), in_use},
      {"in use at one of all addresses", every, in_use_for_all},
      {"not of this machine",
       {htonl(0xc0000201u)},
       "--address 192.0.2.1: this machine has no such address; allowed: its own, 127.0.0.1, 0.0.0.0"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, datagrams_open(&second, row[i].address, first.port, 1, &why));
    CHECK_TEXT(why.text, row[i].line);
  }
  datagrams_close(&first);
}
