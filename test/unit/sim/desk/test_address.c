// test_address.c - what is typed after --address, and what this machine's programs connect to.
#include "desk/address.h"
#include "rig/test.h"

#include <errno.h>

TEST(address_is_an_ipv4_address_and_that_of_all_is_reached_at_the_loopback) {
  static const struct {
    const char *text, *near, *line;
  } row[] = {
      {"127.0.0.1", "127.0.0.1", NULL},
      {"192.168.1.5", "192.168.1.5", NULL},
      {"0.0.0.0", "127.0.0.1", NULL},
      {"localhost", NULL, "--address localhost: allowed is an IPv4 address of this machine, as 127.0.0.1"},
      {"1.2.3", NULL, "--address 1.2.3: allowed is an IPv4 address of this machine, as 127.0.0.1"},
      {"::1", NULL, "--address ::1: allowed is an IPv4 address of this machine, as 127.0.0.1"},
      {"a\nb", NULL, "--address a?b: allowed is an IPv4 address of this machine, as 127.0.0.1"},
      {"", NULL, "--address : allowed is an IPv4 address of this machine, as 127.0.0.1"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].text);
    struct in_addr address;
    why_t why;
    char near[ADDRESS_TEXT];
    const done_t status = address_parse(row[i].text, &address, &why);
    CHECK_STATUS(row[i].line ? BAD_INPUT : DONE, status);
    if (row[i].line)
      CHECK_TEXT(why.text, row[i].line);
    else
      CHECK_TEXT(address_near(address, near), row[i].near);
  }
}

TEST(address_says_what_is_allowed_in_place_of_a_port_of_the_system) {
  why_t why;
  const struct in_addr address = {htonl(INADDR_LOOPBACK)};
  CHECK_STATUS(BAD_INPUT, address_refuse(address, 80, "--page", EACCES, &why));
  CHECK_TEXT(why.text, "--page 80: for the system alone; allowed: 1024 to 65535");
}
