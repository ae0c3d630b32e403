// test_table.c - the table of tests: a test that is written is run.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

TEST(table_refuses_a_test_that_would_never_run) {
  static const struct {
    const char *line;
    int status;
    const char *says;
  } cases[] = {{"TEST(all_small_7) {", 0, ""},
               {"TEST(with_aCapital) {", 1, "test/test_a.c:1:TEST(with_aCapital) {: never run"},
               {"  TEST(set_in) {", 1, "test/test_a.c:1:  TEST(set_in) {: never run"}};
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    char line[300], text[600];
    ROW("%s", cases[i].line);
    snprintf(line, sizeof line,
             "here=$PWD; mkdir -p $S/t/test; cd $S/t; echo '%s' >test/test_a.c; rm -f made.c; "
             "$here/tools/table.sh test made.c; status=$?; test -e made.c || exit $status",
             cases[i].line);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == cases[i].status);
    CHECK(cases[i].says[0] ? strstr(text, cases[i].says) != NULL : text[0] == '\0');
  }
}
