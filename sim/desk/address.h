// address.h - where the desk listens: an IPv4 address, how this machine's own programs reach it, and why
// nothing can listen there.
#ifndef SIM_DESK_ADDRESS_H
#define SIM_DESK_ADDRESS_H

#include "base/error.h"
#include <netinet/in.h>
#include <stdbool.h>

#define ADDRESS_TEXT INET_ADDRSTRLEN

// BAD_INPUT: not an IPv4 address such as 127.0.0.1.
MUST_CHECK done_t address_parse(const char *text, struct in_addr *address, why_t *why);

// True for 0.0.0.0, every address that this machine has: one listens on it, and cannot connect to it.
bool address_is_every(struct in_addr address);

// Returns the address that a program on this machine connects to, as text.
const char *address_near(struct in_addr address, char text[ADDRESS_TEXT]);

// Returns BAD_INPUT for an errno of bind(2), and says who is there already, or what is allowed in its place.
// option: the option that gave the port.
done_t address_refuse(struct in_addr address, int port, const char *option, int error, why_t *why);

#endif
