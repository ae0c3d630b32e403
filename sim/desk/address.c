// address.c - where the desk listens.
#define _POSIX_C_SOURCE 200809L
#include "desk/address.h"

#include "base/number.h"
#include <arpa/inet.h>
#include <errno.h>
#include <string.h>

done_t address_parse(const char *text, struct in_addr *address, why_t *why) {
  char shown[NUMBER_SHOWN];
  if (inet_pton(AF_INET, text, address) == 1) return DONE;
  return error_set(why, "--address %s: allowed is an IPv4 address of this machine, as 127.0.0.1",
                   number_shown(text, shown));
}

bool address_is_every(struct in_addr address) {
  return address.s_addr == htonl(INADDR_ANY);
}

const char *address_near(struct in_addr address, char text[ADDRESS_TEXT]) {
  if (address_is_every(address)) address.s_addr = htonl(INADDR_LOOPBACK);
  return inet_ntop(AF_INET, &address, text, ADDRESS_TEXT);
}

done_t address_refuse(struct in_addr address, int port, const char *option, int error, why_t *why) {
  char text[ADDRESS_TEXT];
  inet_ntop(AF_INET, &address, text, sizeof text);
  switch (error) {
  case EADDRINUSE:
    return error_set(why, "%s:%d: in use; another %s, or is it running already?", text, port, option);
  case EADDRNOTAVAIL:
    return error_set(
        why, "--address %s: this machine has no such address; allowed: its own, 127.0.0.1, 0.0.0.0", text);
  case EACCES: return error_set(why, "%s %d: for the system alone; allowed: 1024 to 65535", option, port);
  default: return error_set(why, "%s:%d: %s", text, port, strerror(error));
  }
}
