// test_http.c - the server of the page, through a socket of the same process.
#define _GNU_SOURCE // memmem
#include "desk/http.h"
#include "desk/page.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <arpa/inet.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define WAIT_MS 2000 // far longer than an answer takes

// --- a desk with one parameter ----------------------------------------------------------------------------

typedef struct {
  bool no_memory;
  int drone;
  double ceiling_m; // as it was set last
} desk_t;

static char *state(void *context) {
  return ((const desk_t *)context)->no_memory ? NULL : strdup("{\"drones\": []}");
}

static const char *set(void *context, int drone, const char *name, double value) {
  desk_t *const desk = context;
  if (strcmp(name, "ceiling") != 0) return "allowed: ceiling";
  if (!(value >= 0.2 && value <= 4.0)) return "ceiling: allowed: 0.2 to 4 m";
  desk->drone = drone;
  desk->ceiling_m = value;
  return NULL;
}

typedef struct {
  desk_t desk;
  http_answers_t answers;
  http_t *http;
} rig_t;

static bool rig_open(rig_t *rig) {
  why_t why;
  *rig = (rig_t){.desk.drone = -1};
  rig->answers = (http_answers_t){&rig->desk, state, set};
  return CHECK_OK(http_open(&rig->http, (struct in_addr){htonl(INADDR_LOOPBACK)}, 0, &rig->answers, &why));
}

// --- a client that turns the server while it waits --------------------------------------------------------

typedef struct {
  int status; // 0: none came
  char head[2000];
  char *body; // a null at its end
  size_t size;
} answer_t;

static int dial(const rig_t *rig) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  const struct sockaddr_in to = {.sin_family = AF_INET,
                                 .sin_port = htons((uint16_t)http_port(rig->http)),
                                 .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
  CHECK(connect(fd, (const struct sockaddr *)&to, sizeof to) == 0);
  return fd;
}

// Until the client has something to read; false: nothing comes.
static bool turn(rig_t *rig, int fd) {
  struct pollfd both[2] = {{.fd = fd, .events = POLLIN}, {.fd = http_fd(rig->http), .events = POLLIN}};
  while (poll(both, 2, WAIT_MS) > 0) {
    if (both[1].revents) http_run(rig->http);
    if (both[0].revents) return true;
  }
  return false;
}

// One whole answer, and not a byte of the next.
static answer_t hear(rig_t *rig, int fd, bool head_only) {
  answer_t a = {.status = 0};
  size_t n = 0;
  while (!strstr(a.head, "\r\n\r\n") && n + 1 < sizeof a.head && turn(rig, fd) &&
         read(fd, a.head + n, 1) == 1)
    n++;
  sscanf(a.head, "HTTP/1.1 %d", &a.status);
  const char *const length = strcasestr(a.head, "\r\nContent-Length:");
  const size_t want = length && !head_only ? (size_t)atol(length + strlen("\r\nContent-Length:")) : 0;
  a.body = calloc(1, want + 1);
  while (a.size < want && turn(rig, fd)) {
    const ssize_t got = read(fd, a.body + a.size, want - a.size);
    if (got <= 0) break;
    a.size += (size_t)got;
  }
  CHECK(a.size == want);
  return a;
}

static void tell(int fd, const void *bytes, size_t size) {
  CHECK(send(fd, bytes, size, MSG_NOSIGNAL) == (ssize_t)size);
}

// The text with each PORT in it replaced by the server's.
static const char *with_port(const rig_t *rig, const char *text) {
  static char out[4000];
  size_t n = 0;
  for (; *text && n + 8 < sizeof out; text++) {
    if (strncmp(text, "PORT", 4) == 0) {
      n += (size_t)sprintf(out + n, "%d", http_port(rig->http));
      text += 3;
    } else {
      out[n++] = *text;
    }
  }
  out[n] = '\0';
  return out;
}

static answer_t ask(rig_t *rig, const char *request) {
  const int fd = dial(rig);
  const char *const text = with_port(rig, request);
  tell(fd, text, strlen(text));
  const answer_t a = hear(rig, fd, strncmp(request, "HEAD", 4) == 0);
  close(fd);
  return a;
}

static void check_answer(rig_t *rig, const char *request, int status, const char *body) {
  const answer_t a = ask(rig, request);
  CHECK_NEAR(a.status, status, 0);
  if (body) CHECK_TEXT(a.body, body);
  CHECK(!strcasestr(a.head, "Access-Control"));
  free(a.body);
}

#define HOST  "Host: 127.0.0.1:PORT\r\n"
#define STATE "GET /state HTTP/1.1\r\n" HOST "\r\n"
#define FORM  "Content-Type: application/x-www-form-urlencoded\r\n"
#define SET   "POST /set HTTP/1.1\r\n" HOST FORM

static void check_serves(rig_t *rig) {
  check_answer(rig, STATE, 200, "{\"drones\": []}");
}

// --- tests ------------------------------------------------------------------------------------------------

TEST(http_serves_the_page_as_it_was_written_and_lets_nothing_else_run_in_it) {
  rig_t rig;
  if (!rig_open(&rig)) return;
  const answer_t a = ask(&rig, "GET / HTTP/1.1\r\n" HOST "\r\n");
  CHECK_NEAR(a.status, 200, 0);
  CHECK(a.size == page_size && memcmp(a.body, page_html, page_size) == 0);
  CHECK(strcasestr(a.head, "\r\nContent-Type: text/html; charset=utf-8\r\n"));
  CHECK(strcasestr(a.head, "\r\nContent-Security-Policy: default-src 'none'; script-src 'sha256-"));
  CHECK(!strstr(a.head, "unsafe"));
  CHECK(!memmem(page_html, page_size, "src=\"http", 9) && !memmem(page_html, page_size, "@import", 7));
  free(a.body);
  http_close(rig.http);
}

TEST(http_answers_what_is_asked_and_says_what_is_wrong) {
  static const struct {
    const char *what, *request;
    int status;
    const char *body; // null: not looked at
  } row[] = {
      {"state", STATE, 200, "{\"drones\": []}"},
      {"by name", "GET /state HTTP/1.1\r\nHost: LocalHost:PORT\r\n\r\n", 200, NULL},
      {"with a query", "GET /state?now=1 HTTP/1.1\r\n" HOST "\r\n", 200, NULL},
      {"head alone", "HEAD /state HTTP/1.1\r\n" HOST "\r\n", 200, ""},
      {"another path", "GET /state/ HTTP/1.1\r\n" HOST "\r\n", 404, NULL},
      {"a path upwards", "GET /../etc/passwd HTTP/1.1\r\n" HOST "\r\n", 404, NULL},
      {"another method", "DELETE / HTTP/1.1\r\n" HOST "\r\n", 405, "allowed: GET\n"},
      {"set by GET", "GET /set?drone=0&name=ceiling&value=1 HTTP/1.1\r\n" HOST "\r\n", 405,
       "allowed: POST\n"},
      {"options", "OPTIONS /set HTTP/1.1\r\n" HOST "Origin: http://evil.test\r\n\r\n", 405, NULL},
      {"another host", "GET /state HTTP/1.1\r\nHost: evil.test:PORT\r\n\r\n", 403, NULL},
      {"another port", "GET /state HTTP/1.1\r\nHost: 127.0.0.1:1\r\n\r\n", 403, NULL},
      {"no port", "GET /state HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n", 403, NULL},
      {"an address that begins so", "GET /state HTTP/1.1\r\nHost: 127.0.0.1:PORT0\r\n\r\n", 403, NULL},
      {"another address of this machine", "GET /state HTTP/1.1\r\nHost: 127.0.0.2:PORT\r\n\r\n", 403, NULL},
      {"no host", "GET /state HTTP/1.0\r\n\r\n", 403, NULL},
      {"no host in 1.1", "GET /state HTTP/1.1\r\n\r\n", 400, NULL},
  };
  rig_t rig;
  if (!rig_open(&rig)) return;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    check_answer(&rig, row[i].request, row[i].status, row[i].body);
  }
  ROW("out of memory");
  rig.desk.no_memory = true;
  check_answer(&rig, STATE, 500, "out of memory\n");
  http_close(rig.http);
}

#define TAKES "allowed: drone=NUMBER&name=NAME&value=NUMBER, each once\n"
#define LONG  "0000000000000000000000000000000000000000000000001"

static const struct {
  const char *what, *head, *body;
  int status;
  const char *said;
} set_row[] = {
    {"as the page does", "", "drone=3&name=ceiling&value=1.2", 204, ""},
    {"from the page", "Origin: http://127.0.0.1:PORT\r\n", "drone=3&name=ceiling&value=1.2", 204, ""},
    {"in another order, escaped", "", "value=1%2e2&name=c%65iling&drone=3", 204, ""},
    {"refused", "", "drone=3&name=ceiling&value=9", 400, "ceiling: allowed: 0.2 to 4 m\n"},
    {"another name", "", "drone=3&name=floor&value=1", 400, "allowed: ceiling\n"},
    {"no drone", "", "name=ceiling&value=1.2", 400, TAKES},
    {"no name", "", "drone=3&value=1.2", 400, TAKES},
    {"no value", "", "drone=3&name=ceiling", 400, TAKES},
    {"an empty value", "", "drone=3&name=ceiling&value=", 400, TAKES},
    {"nothing", "", "", 400, TAKES},
    {"twice", "", "drone=3&name=ceiling&value=1&value=1.2", 400, TAKES},
    {"more", "", "drone=3&name=ceiling&value=1.2&x=1", 400, TAKES},
    {"half a drone", "", "drone=0.5&name=ceiling&value=1.2", 400, TAKES},
    {"a drone below none", "", "drone=-1&name=ceiling&value=1.2", 400, TAKES},
    {"a drone of no int", "", "drone=1e10&name=ceiling&value=1.2", 400, TAKES},
    {"no number", "", "drone=3&name=ceiling&value=nan", 400, TAKES},
    {"too large a number", "", "drone=3&name=ceiling&value=1e999", 400, TAKES},
    {"a word behind the number", "", "drone=3&name=ceiling&value=1.2m", 400, TAKES},
    {"a number that ends in the middle", "", "drone=3&name=ceiling&value=1.2%00", 400, TAKES},
    {"a long number", "", "drone=3&name=ceiling&value=" LONG, 400, TAKES},
    {"from another page", "Origin: http://evil.test\r\n", "drone=3&name=ceiling&value=1.2", 403, NULL},
    {"from a page on another port", "Origin: http://127.0.0.1:1\r\n", "drone=3&name=ceiling&value=1.2", 403,
     NULL},
    {"from a file", "Origin: null\r\n", "drone=3&name=ceiling&value=1.2", 403, NULL},
};

TEST(http_sets_what_is_asked_for_and_nothing_of_a_bad_form) {
  rig_t rig;
  if (!rig_open(&rig)) return;
  for (unsigned i = 0; i < sizeof set_row / sizeof *set_row; i++) {
    ROW("%s", set_row[i].what);
    rig.desk = (desk_t){.drone = -1};
    char request[600];
    snprintf(request, sizeof request, SET "%sContent-Length: %zu\r\n\r\n%s", set_row[i].head,
             strlen(set_row[i].body), set_row[i].body);
    check_answer(&rig, request, set_row[i].status, set_row[i].said);
    CHECK_NEAR(rig.desk.drone, set_row[i].status == 204 ? 3 : -1, 0);
    CHECK_NEAR(rig.desk.ceiling_m, set_row[i].status == 204 ? 1.2 : 0.0, 0);
  }
  http_close(rig.http);
}

TEST(http_takes_no_body_that_is_long_or_of_unknown_length_or_no_form) {
  static const struct {
    const char *what, *head;
    size_t body;
    int status;
  } row[] = {
      {"as long as may be", SET "Content-Length: 1024\r\n\r\n", 1024, 400},
      {"a byte more", SET "Content-Length: 1025\r\n\r\n", 1025, 413},
      {"much more than ever comes", SET "Content-Length: 99999999999\r\n\r\n", 0, 413},
      {"behind a GET", "GET /state HTTP/1.1\r\n" HOST "Content-Length: 2000\r\n\r\n", 2000, 413},
      {"in pieces", SET "Transfer-Encoding: chunked\r\n\r\n", 0, 411},
      {"no length", SET "\r\n", 0, 411},
      {"no form", "POST /set HTTP/1.1\r\n" HOST "Content-Type: text/plain\r\nContent-Length: 9\r\n\r\n", 9,
       400},
  };
  rig_t rig;
  if (!rig_open(&rig)) return;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    char request[3000];
    const size_t head = (size_t)sprintf(request, "%s", row[i].head);
    memset(request + head, 'a', row[i].body);
    request[head + row[i].body] = '\0';
    check_answer(&rig, request, row[i].status, NULL);
  }
  check_serves(&rig);
  http_close(rig.http);
}

TEST(http_keeps_a_connection_for_further_requests_however_they_come) {
  rig_t rig;
  if (!rig_open(&rig)) return;
  const int fd = dial(&rig);
  for (int i = 0; i < 3; i++) {
    ROW("request %d", i);
    const char *const text = with_port(&rig, STATE);
    tell(fd, text, strlen(text));
    const answer_t a = hear(&rig, fd, false);
    CHECK_NEAR(a.status, 200, 0);
    free(a.body);
  }
  ROW("two at once");
  const char *const two = with_port(&rig, STATE STATE);
  tell(fd, two, strlen(two));
  for (int i = 0; i < 2; i++) {
    const answer_t a = hear(&rig, fd, false);
    CHECK_TEXT(a.body, "{\"drones\": []}");
    free(a.body);
  }
  ROW("byte by byte");
  for (const char *c = with_port(&rig, SET "Content-Length: 30\r\n\r\ndrone=3&name=ceiling&value=1.2"); *c;
       c++) {
    tell(fd, c, 1);
    http_run(rig.http);
  }
  const answer_t a = hear(&rig, fd, false);
  CHECK_NEAR(a.status, 204, 0);
  CHECK_NEAR(rig.desk.ceiling_m, 1.2, 0);
  free(a.body);
  close(fd);
  http_close(rig.http);
}

TEST(http_serves_on_whatever_a_connection_sends_or_leaves_open) {
  rig_t rig;
  if (!rig_open(&rig)) return;
  splitmix_t random = {1};
  for (int i = 0; i < 200; i++) {
    ROW("garbage %d", i);
    unsigned char bytes[1500];
    for (size_t k = 0; k < sizeof bytes; k++) bytes[k] = (unsigned char)(splitmix_bits(&random) >> 56);
    // Some begin as a request does.
    if (i % 2) memcpy(bytes, "POST /set HTTP/1.1\r\nHost: ", 26);
    const int fd = dial(&rig);
    tell(fd, bytes, splitmix_bits(&random) % sizeof bytes);
    http_run(rig.http);
    close(fd);
  }
  check_serves(&rig);

  ROW("left in the middle of the page");
  for (int i = 0; i < 20; i++) {
    const int fd = dial(&rig);
    const char *const text = with_port(&rig, "GET / HTTP/1.1\r\n" HOST "\r\n");
    tell(fd, text, strlen(text));
    close(fd);
  }
  check_serves(&rig);

  ROW("more connections than it holds");
  int open[40];
  for (int i = 0; i < 40; i++) {
    open[i] = dial(&rig);
    http_run(rig.http);
  }
  for (int i = 0; i < 40; i++) {
    close(open[i]);
    http_run(rig.http);
  }
  check_serves(&rig);
  http_close(rig.http);
}

TEST(http_at_every_address_answers_to_the_one_that_was_come_to_and_says_so) {
  rig_t rig = {.answers = {&rig.desk, state, set}};
  why_t why;
  CHECK_OK(http_open(&rig.http, (struct in_addr){htonl(INADDR_ANY)}, 0, &rig.answers, &why));
  char says[100];
  snprintf(says, sizeof says, "another host's name than this one's; allowed: 127.0.0.1:%d, localhost:%d\n",
           http_port(rig.http), http_port(rig.http));
  check_serves(&rig);
  check_answer(&rig, "GET /state HTTP/1.1\r\nHost: 0.0.0.0:PORT\r\n\r\n", 403, says);
  http_close(rig.http);
}

TEST(http_says_in_one_line_why_it_cannot_listen) {
  rig_t rig;
  if (!rig_open(&rig)) return;
  char in_use[100];
  snprintf(in_use, sizeof in_use, "127.0.0.1:%d: in use; another --page (0: none), or is it running already?",
           http_port(rig.http));
  const struct {
    const char *what;
    uint32_t address;
    int port;
    const char *line;
  } row[] = {
      {"in use", INADDR_LOOPBACK, http_port(rig.http), in_use},
      {"not of this machine", 0xc0000201u, 0,
       "--address 192.0.2.1: this machine has no such address; allowed: its own, 127.0.0.1, 0.0.0.0"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    why_t why = {""};
    http_t *second = NULL;
    const struct in_addr address = {htonl(row[i].address)};
    CHECK_STATUS(BAD_INPUT, http_open(&second, address, row[i].port, &rig.answers, &why));
    CHECK_TEXT(why.text, row[i].line);
    CHECK(second == NULL);
  }
  ROW("a port of one that was closed");
  const int port = http_port(rig.http);
  check_serves(&rig);
  http_close(rig.http);
  why_t why;
  CHECK_OK(http_open(&rig.http, (struct in_addr){htonl(INADDR_LOOPBACK)}, port, &rig.answers, &why));
  check_serves(&rig);
  http_close(rig.http);
}
