// http.c - GET /, GET /state, POST /set, over libmicrohttpd.
#define _GNU_SOURCE // SOCK_NONBLOCK, SOCK_CLOEXEC
#include "desk/http.h"

#include "base/number.h"
#include "desk/address.h"
#include "desk/page.h"

#include <arpa/inet.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <microhttpd.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#define CONNECTIONS 32u   // a browser holds six
#define SILENT_S    30u   // s; after that a connection is ended
#define BODY_MAX    1024u // bytes
#define HOST_MAX    32    // "255.255.255.255:65535", "localhost:65535"
#define WORD_MAX    40    // a name or a number of /set, with its final 0
#define ROUNDS      64    // of the library in one http_run: enough to answer all that has come

struct http {
  struct MHD_Daemon *daemon;
  const http_answers_t *answers;
  int port;
  int epoll;      // one descriptor that stands for all that the library waits for
  fd_set watched; // descriptors that are in it, or were until they were closed
  int last;       // the largest of them
  bool more;      // the library still has something to do
  time_t turned;  // when the library last ran
};

// A field of /set as it comes, in pieces.
typedef struct {
  char text[WORD_MAX];
  size_t size;
  bool given;
} word_t;

enum { DRONE, NAME, VALUE, WORDS };
static const char *const word_key[WORDS] = {"drone", "name", "value"};
#define SET_TAKES "allowed: drone=NUMBER&name=NAME&value=NUMBER, each once"

typedef struct {
  struct MHD_PostProcessor *reader; // null where no form is expected, or the body is none
  word_t word[WORDS];
  bool odd; // it has something that is not taken
} request_t;

typedef enum MHD_Result result_t;
typedef struct MHD_Connection connection_t;

// --- answers ----------------------------------------------------------------------------------------------

// Queues the response and releases it. A null response ends the connection.
static result_t respond(connection_t *c, unsigned status, const char *type, struct MHD_Response *response) {
  if (!response) return MHD_NO;
  MHD_add_response_header(response, MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
  MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
  if (type) MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, type);
  const result_t queued = MHD_queue_response(c, status, response);
  MHD_destroy_response(response);
  return queued;
}

static result_t say(connection_t *c, unsigned status, const char *line) {
  char text[512];
  const int n = snprintf(text, sizeof text, "%.500s\n", line);
  return respond(c, status, "text/plain; charset=utf-8",
                 MHD_create_response_from_buffer((size_t)n, text, MHD_RESPMEM_MUST_COPY));
}

static result_t get_page(const http_t *http, connection_t *c, request_t *request) {
  (void)http;
  (void)request;
  // The library only reads the page. Its argument is not const for callers that hand their memory over.
  union {
    const unsigned char *here;
    void *there;
  } page = {.here = page_html};
  struct MHD_Response *const response =
      MHD_create_response_from_buffer(page_size, page.there, MHD_RESPMEM_PERSISTENT);
  if (response) MHD_add_response_header(response, "Content-Security-Policy", page_policy);
  return respond(c, MHD_HTTP_OK, "text/html; charset=utf-8", response);
}

static result_t get_state(const http_t *http, connection_t *c, request_t *request) {
  (void)request;
  char *const json = http->answers->state(http->answers->context);
  if (!json) return say(c, MHD_HTTP_INTERNAL_SERVER_ERROR, "out of memory");
  struct MHD_Response *const response =
      MHD_create_response_from_buffer(strlen(json), json, MHD_RESPMEM_MUST_FREE);
  if (!response) free(json);
  return respond(c, MHD_HTTP_OK, "application/json", response);
}

static const char *set(const http_t *http, const request_t *r) {
  double drone, value;
  if (r->odd || !number_parse(r->word[DRONE].text, &drone) || !r->word[NAME].given ||
      !number_parse(r->word[VALUE].text, &value) || !isfinite(value) ||
      !(drone >= 0.0 && drone < INT_MAX && drone == floor(drone)))
    return SET_TAKES;
  return http->answers->set(http->answers->context, (int)drone, r->word[NAME].text, value);
}

static result_t post_set(const http_t *http, connection_t *c, request_t *request) {
  const char *const refused = set(http, request);
  if (refused) return say(c, MHD_HTTP_BAD_REQUEST, refused);
  return respond(c, MHD_HTTP_NO_CONTENT, NULL,
                 MHD_create_response_from_buffer(0, NULL, MHD_RESPMEM_PERSISTENT));
}

typedef struct {
  const char *path, *method;
  result_t (*answer)(const http_t *http, connection_t *c, request_t *request);
} route_t;

static const route_t route[] = {
    {"/", "GET", get_page},
    {"/state", "GET", get_state},
    {"/set", "POST", post_set},
};

static const route_t *route_of(const char *path) {
  for (size_t i = 0; i < sizeof route / sizeof *route; i++)
    if (strcmp(route[i].path, path) == 0) return &route[i];
  return NULL;
}

// HEAD is a GET of which the library leaves out the body.
static bool is_method(const route_t *at, const char *method) {
  return strcmp(at->method, strcmp(method, "HEAD") == 0 ? "GET" : method) == 0;
}

// --- who may ask ------------------------------------------------------------------------------------------

static const char *header(connection_t *c, const char *name) {
  return MHD_lookup_connection_value(c, MHD_HEADER_KIND, name);
}

// True if host is name:port. A foreign name that was made to resolve to this machine is refused by this.
static bool host_is(const char *host, const char *name, int port) {
  char full[HOST_MAX];
  snprintf(full, sizeof full, "%s:%d", name, port);
  return strcasecmp(host, full) == 0 || (port == 80 && strcasecmp(host, name) == 0);
}

// True if the Host header names this server. Fills address: the one that the connection came to.
static bool asks_us(connection_t *c, int port, char address[ADDRESS_TEXT]) {
  const char *const host = header(c, MHD_HTTP_HEADER_HOST);
  const union MHD_ConnectionInfo *const info = MHD_get_connection_info(c, MHD_CONNECTION_INFO_CONNECTION_FD);
  struct sockaddr_in came_to;
  socklen_t size = sizeof came_to;
  strcpy(address, "localhost");
  if (!info || getsockname(info->connect_fd, (struct sockaddr *)&came_to, &size) != 0) return false;
  inet_ntop(AF_INET, &came_to.sin_addr, address, ADDRESS_TEXT);
  return host && (host_is(host, address, port) || host_is(host, "localhost", port));
}

// True if the POST has no Origin, or that of the Host header, which asks_us() has checked.
static bool from_our_page(connection_t *c) {
  static const char scheme[] = "http://";
  const char *const origin = header(c, MHD_HTTP_HEADER_ORIGIN);
  return !origin || (strncasecmp(origin, scheme, strlen(scheme)) == 0 &&
                     strcasecmp(origin + strlen(scheme), header(c, MHD_HTTP_HEADER_HOST)) == 0);
}

static bool too_long(const char *length) {
  double bytes;
  return length && !(number_parse(length, &bytes) && bytes >= 0.0 && bytes <= BODY_MAX);
}

static result_t wrong_method(connection_t *c, const route_t *at) {
  char line[HOST_MAX];
  const int n = snprintf(line, sizeof line, "allowed: %s\n", at->method);
  struct MHD_Response *const response =
      MHD_create_response_from_buffer((size_t)n, line, MHD_RESPMEM_MUST_COPY);
  if (response) MHD_add_response_header(response, MHD_HTTP_HEADER_ALLOW, at->method);
  return respond(c, MHD_HTTP_METHOD_NOT_ALLOWED, "text/plain; charset=utf-8", response);
}

// --- one request ------------------------------------------------------------------------------------------

static result_t take_word(void *context, enum MHD_ValueKind kind, const char *key, const char *filename,
                          const char *type, const char *encoding, const char *bytes, uint64_t offset,
                          size_t size) {
  (void)kind;
  (void)filename;
  (void)type;
  (void)encoding;
  request_t *const r = context;
  int at = 0;
  while (at < WORDS && strcmp(word_key[at], key) != 0) at++;
  if (at == WORDS || (offset == 0 && r->word[at].given)) {
    r->odd = true;
    return MHD_YES;
  }
  word_t *const word = &r->word[at];
  word->given = true;
  for (size_t i = 0; i < size; i++) {
    if (word->size + 1 < sizeof word->text && bytes[i] > ' ' && bytes[i] <= '~')
      word->text[word->size++] = bytes[i];
    else
      r->odd = true;
  }
  return MHD_YES;
}

// The head of a request has come: refuses it, or makes the request_t that takes its body.
static result_t begin(const http_t *http, connection_t *c, const char *path, const char *method,
                      void **request) {
  const route_t *const at = route_of(path);
  char address[ADDRESS_TEXT], line[128];
  if (!asks_us(c, http->port, address)) {
    snprintf(line, sizeof line, "another host's name than this one's; allowed: %s:%d, localhost:%d", address,
             http->port, http->port);
    return say(c, MHD_HTTP_FORBIDDEN, line);
  }
  if (!at) return say(c, MHD_HTTP_NOT_FOUND, "there are: / /state /set");
  if (!is_method(at, method)) return wrong_method(c, at);
  const bool post = strcmp(method, "POST") == 0;
  const char *const length = header(c, MHD_HTTP_HEADER_CONTENT_LENGTH);
  if (post && !from_our_page(c)) return say(c, MHD_HTTP_FORBIDDEN, "from a page of another origin");
  if (header(c, MHD_HTTP_HEADER_TRANSFER_ENCODING) || (post && !length))
    return say(c, MHD_HTTP_LENGTH_REQUIRED, "a body says its length before it comes");
  if (too_long(length)) return say(c, MHD_HTTP_CONTENT_TOO_LARGE, "a body has at most 1024 bytes");

  request_t *const r = calloc(1, sizeof *r);
  if (!r) return MHD_NO;
  if (post) r->reader = MHD_create_post_processor(c, BODY_MAX, take_word, r);
  r->odd = post && !r->reader; // no form
  *request = r;
  return MHD_YES;
}

static result_t heard(void *context, connection_t *c, const char *path, const char *method,
                      const char *version, const char *bytes, size_t *size, void **request) {
  (void)version;
  const http_t *const http = context;
  request_t *const r = *request;
  if (!r) return begin(http, c, path, method, request);
  if (*size == 0) {
    // Only this completes the last field.
    if (r->reader && MHD_destroy_post_processor(r->reader) != MHD_YES) r->odd = true;
    r->reader = NULL;
    return route_of(path)->answer(http, c, r);
  }
  if (r->reader && MHD_post_process(r->reader, bytes, *size) != MHD_YES) r->odd = true;
  *size = 0;
  return MHD_YES;
}

static void forget(void *context, connection_t *c, void **request, enum MHD_RequestTerminationCode why) {
  (void)context;
  (void)c;
  (void)why;
  request_t *const r = *request;
  if (r && r->reader) MHD_destroy_post_processor(r->reader);
  free(r);
  *request = NULL;
}

// --- the server -------------------------------------------------------------------------------------------

// Opens a socket that listens; *port becomes its actual port.
static done_t listens(int *fd, struct in_addr address, int *port, why_t *why) {
  struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((uint16_t)*port), .sin_addr = address};
  *fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (*fd < 0) return error_failed(why, "no socket: %s", strerror(errno));
  // Connections that an earlier server left waiting do not count as another server.
  const int on = 1;
  socklen_t size = sizeof at;
  if (setsockopt(*fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
      bind(*fd, (struct sockaddr *)&at, sizeof at) == 0 && listen(*fd, (int)CONNECTIONS) == 0 &&
      getsockname(*fd, (struct sockaddr *)&at, &size) == 0) {
    *port = ntohs(at.sin_port);
    return DONE;
  }
  const int error = errno;
  close(*fd);
  return address_refuse(address, *port, "--page (0: none)", error, why);
}

// Puts the library's descriptors into `epoll`. The library's own epoll would do, but it misses the end of a
// connection that comes with its last bytes.
static void watch(http_t *http) {
  fd_set in, out, except;
  int last = -1;
  FD_ZERO(&in);
  FD_ZERO(&out);
  FD_ZERO(&except);
  if (MHD_get_fdset(http->daemon, &in, &out, &except, &last) != MHD_YES) return;
  for (int fd = 0; fd <= http->last || fd <= last; fd++) {
    struct epoll_event event = {.events = (FD_ISSET(fd, &in) ? (uint32_t)EPOLLIN : 0u) |
                                          (FD_ISSET(fd, &out) ? (uint32_t)EPOLLOUT : 0u)};
    if (event.events) {
      // A descriptor that was closed is no longer in it, though a new one may have its number.
      if (epoll_ctl(http->epoll, EPOLL_CTL_MOD, fd, &event) != 0)
        epoll_ctl(http->epoll, EPOLL_CTL_ADD, fd, &event);
      FD_SET(fd, &http->watched);
    } else if (FD_ISSET(fd, &http->watched)) {
      epoll_ctl(http->epoll, EPOLL_CTL_DEL, fd, NULL);
      FD_CLR(fd, &http->watched);
    }
  }
  http->last = last;
}

static struct MHD_Daemon *start(http_t *h, int fd) {
  return MHD_start_daemon(MHD_NO_FLAG, 0, NULL, NULL, heard, h, MHD_OPTION_LISTEN_SOCKET, fd,
                          MHD_OPTION_CONNECTION_LIMIT, CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT, SILENT_S,
                          MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_NOTIFY_COMPLETED, forget, NULL,
                          MHD_OPTION_END);
}

done_t http_open(http_t **http, struct in_addr address, int port, const http_answers_t *answers, why_t *why) {
  int fd = -1;
  TRY(listens(&fd, address, &port, why));
  http_t *const h = calloc(1, sizeof *h);
  if (h) {
    *h = (http_t){.answers = answers, .port = port, .epoll = epoll_create1(EPOLL_CLOEXEC)};
    FD_ZERO(&h->watched);
    h->daemon = h->epoll >= 0 ? start(h, fd) : NULL;
  }
  if (!h || !h->daemon) {
    close(fd);
    if (h && h->epoll >= 0) close(h->epoll);
    free(h);
    return error_failed(why, "--page %d: no server: out of memory or of descriptors", port);
  }
  watch(h);
  *http = h;
  return DONE;
}

int http_port(const http_t *http) {
  return http->port;
}

int http_fd(const http_t *http) {
  return http->epoll;
}

void http_run(http_t *http) {
  // A loop that flies in real time calls a thousand times a second: mostly there is nothing to do.
  struct epoll_event any;
  const time_t now = time(NULL);
  if (!http->more && now == http->turned && epoll_wait(http->epoll, &any, 1, 0) == 0) return;
  http->turned = now;
  http->more = true;
  for (int i = 0; i < ROUNDS && http->more; i++) {
    // Bytes that the library has already read make no descriptor ready: it tells of them by a timeout of 0.
    MHD_UNSIGNED_LONG_LONG wait_ms = 1;
    http->more = MHD_run(http->daemon) == MHD_YES && MHD_get_timeout(http->daemon, &wait_ms) == MHD_YES &&
                 wait_ms == 0;
  }
  watch(http);
}

void http_close(http_t *http) {
  if (!http) return;
  MHD_stop_daemon(http->daemon);
  close(http->epoll);
  free(http);
}
