// address.h - where the desk listens: an IPv4 address, how this machine's own programs reach it, and why
// nothing can listen there.
#ifndef SIM_DESK_ADDRESS_H
#define SIM_DESK_ADDRESS_H

#include "base/error.h"
#include <netinet/in.h>
#include <stdbool.h>

#define ADDRESS_TEXT INET_ADDRSTRLEN

// BAD_INPUT: none of the kind, as 127.0.0.1.
MUST_CHECK done_t address_parse(const char *text, struct in_addr *address, why_t *why);

// 0.0.0.0: every address that this machine has. It is one to listen on, and none to connect to.
bool address_is_every(struct in_addr address);

// What a program on this machine connects to.
const char *address_near(struct in_addr address, char text[ADDRESS_TEXT]);

// BAD_INPUT, for bind(2)'s errno: who is there already, or what is allowed in place of this. option: that the
// port came by.
done_t address_refuse(struct in_addr address, int port, const char *option, int error, why_t *why);

#endif
