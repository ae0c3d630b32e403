// http.h - the page, what it shows and what it sets, over HTTP/1.1: a server without a thread, turned by the
// program's own loop.
//
//   GET  /       the page (desk/page.h)
//   GET  /state  what is now, as JSON
//   POST /set    drone=0&name=ceiling&value=1.2   204, or 400 with one line that says what is allowed
//
// A page of somebody else's in the same browser can neither read nor set: the Host header must name the
// address that the connection came to, or localhost, with the port; a POST that says its Origin must come
// from there; nothing is said about other origins (403 says which host is allowed). What is not there is 404,
// another method 405, a body of more than 1 kB 413, one of unknown length 411.
#ifndef SIM_DESK_HTTP_H
#define SIM_DESK_HTTP_H

#include "base/error.h"
#include <netinet/in.h>

typedef struct http http_t;

// Who answers: called in http_run alone.
typedef struct {
  void *context;
  // What is now, as desk/page.h has it; the server frees it. Null: out of memory.
  char *(*state)(void *context);
  // Sets a parameter of the group `desk` of a drone, 0 the first; value is finite. Null: done; else one line
  // that says what is allowed, good until the next call.
  const char *(*set)(void *context, int drone, const char *name, double value);
} http_answers_t;

// Listens on an address and a port, 0: any that is free. answers stays the caller's, until http_close.
// BAD_INPUT: it cannot be listened on, and why. FAILED: memory.
MUST_CHECK done_t http_open(http_t **http, struct in_addr address, int port, const http_answers_t *answers,
                            why_t *why);

// The port that is listened on.
int http_port(const http_t *http);

// Can be read, by poll(2), when there is something to do.
int http_fd(const http_t *http);

// Does what there is to do, and never waits; where there is nothing it costs one system call. Called once a
// second or so without a reason too, it ends connections that say nothing.
void http_run(http_t *http);

// Null is nothing to close.
void http_close(http_t *http);

#endif
