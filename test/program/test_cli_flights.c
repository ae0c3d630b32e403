// test_cli_flights.c - the script that flies the thesis's flights, and its table.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

#define SEGMENT                                                                                              \
  "\"setpoint_m\":0.4,\"mean_error_mm\":1,\"sd_mm\":2,\"contacts\":0,\"tilt_max_deg\":3,\"min_gap_mm\":90"
#define TURNED                                                                                               \
  "\"min_gap_mm\":90,\"tilt_max_deg\":3,\"contacts\":0,\"sd_mm\":2,\"mean_error_mm\":1,\"setpoint_m\":0.4"
#define NULLED                                                                                               \
  "\"setpoint_m\":0.4,\"mean_error_mm\":null,\"sd_mm\":2,\"contacts\":0,\"tilt_max_deg\":3,\"min_gap_mm\":"  \
  "90"

TEST(flights_table_reads_a_flight_in_any_order_of_its_keys) {
  static const char *const line[] = {
      "{\"segments\":[{" SEGMENT "},{" SEGMENT "}],\"ceiling_m\":0.5,\"rotor_radius_m\":0.02}",
      "{\"rotor_radius_m\":0.02,\"ceiling_m\":0.5,\"segments\":[{" TURNED "},{" TURNED "}]}",
  };
  char text[2][2000], shell[1200];
  for (int i = 0; i < 2; i++) {
    snprintf(shell, sizeof shell, "echo '%s' >$S/x.indi.jsonl; awk -f tools/flights.awk $S/x.indi.jsonl",
             line[i]);
    CHECK(program_run(shell, STREAM_OUTPUT, text[i], sizeof text[i]) == 0);
  }
  CHECK(strstr(text[0], " 100  5.00    99.0  4.95     2.0  0.10     1.0     2.0      0     0/1    90.0") !=
        NULL);
  CHECK_TEXT(text[1], text[0]);
}

TEST(flights_table_refuses_a_flight_without_a_number) {
  static const char *const line[] = {
      "{\"segments\":[{" SEGMENT "},{" NULLED "}],\"ceiling_m\":0.5,\"rotor_radius_m\":0.02}",
      "{\"segments\":[{" SEGMENT "},{" SEGMENT "}],\"rotor_radius_m\":0.02}",
  };
  for (int i = 0; i < 2; i++) {
    char text[2000], shell[1200];
    snprintf(shell, sizeof shell, "echo '%s' >$S/x.indi.jsonl; awk -f tools/flights.awk $S/x.indi.jsonl",
             line[i]);
    CHECK(program_run(shell, STREAM_ERROR, text, sizeof text) == 1);
    CHECK(strstr(text, i == 0 ? "no number mean_error_mm\n" : "no number ceiling_m\n") != NULL);
  }
}

TEST(flights_script_ends_where_a_flight_fails) {
  // Stands in for out/fly: each fails in its own way.
  static const struct {
    const char *fly, *line;
  } row[] = {
      {"echo \"fly: no\" >&2; exit 1", "fly: no\n"},
      {"while [ \"$1\" != --json ]; do shift; done; echo {} >\"$2\"",
       "flights.sh: out/flights/test-flight.indi.jsonl: not the 10 flights that were asked for\n"},
  };
  for (int i = 0; i < 2; i++) {
    ROW("%s", row[i].line);
    char text[2000], shell[600];
    snprintf(shell, sizeof shell,
             "mkdir -p $S/fl/out; ln -sfn $PWD/tools $S/fl/tools; printf '#!/bin/sh\\n%%s\\n' '%s' "
             ">$S/fl/out/fly; "
             "chmod +x $S/fl/out/fly; cd $S/fl && O=out tools/flights.sh",
             row[i].fly);
    CHECK(program_run(shell, STREAM_ERROR, text, sizeof text) == 1);
    CHECK_TEXT(text, row[i].line);
  }
}
