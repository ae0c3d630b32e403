// http.h - the page, what it shows and what it sets, over HTTP/1.1: a server without a thread of its own, run
// by the program's loop.
//
//   GET  /       the page (desk/page.h)
//   GET  /state  the present state, as JSON
//   POST /set    drone=0&name=ceiling&value=1.2   204, or 400 with one line that says what is allowed
//
// A foreign page in the same browser can neither read nor set. The Host header must name the address that the
// connection came to, or localhost, with the port; the Origin of a POST, if it has one, must be the same.
// Otherwise the answer is 403, which for a wrong host says the allowed ones. No header allows other origins.
// Other errors: 404 for an unknown path, 405 for another method, 413 for a body of more than 1 kB, 411 for
// one of unknown length.
#ifndef SIM_DESK_HTTP_H
#define SIM_DESK_HTTP_H

#include "base/error.h"
#include <netinet/in.h>

typedef struct http http_t;

// Functions that answer; called within http_run only.
typedef struct {
  void *context;
  // Returns the present state as desk/page.h has it; the server frees it. Null: out of memory.
  char *(*state)(void *context);
  // Sets a parameter of the group `desk` of a drone, 0 the first; value is finite. Returns null, or one line
  // that says what is allowed, valid until the next call.
  const char *(*set)(void *context, int drone, const char *name, double value);
} http_answers_t;

// Listens on an address and a port, 0: any that is free. answers is the caller's, and must last until
// http_close. BAD_INPUT: they cannot be listened on, and why. FAILED: memory.
MUST_CHECK done_t http_open(http_t **http, struct in_addr address, int port, const http_answers_t *answers,
                            why_t *why);

// The port that is listened on.
int http_port(const http_t *http);

// Returns a descriptor that poll(2) finds readable when there is something to do.
int http_fd(const http_t *http);

// Does what there is to do, and never waits; with nothing to do it costs one system call. To be called about
// once a second even without a reason, so that silent connections end.
void http_run(http_t *http);

// http may be null.
void http_close(http_t *http);

#endif
