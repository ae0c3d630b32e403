// test_packages.c - tools/setup.sh, with stand-ins for dpkg and apt: what it says, and to whom.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

// Only g++ is installed.
#define STAND_INS                                                                                            \
  "mkdir -p $S/pk; cd $S/pk; stand_in() { printf '#!/bin/sh\\n%s\\n' \"$2\" >$1; chmod +x $1; }; "           \
  "stand_in dpkg-query '[ \"$3\" = g++ ] && echo install ok installed'; "                                    \
  "stand_in apt-get 'case $* in "                                                                            \
  "*assume-no*) echo 0 upgraded, 2 newly installed, 0 to remove and 0 not upgraded.; "                       \
  "echo Need to get 31 kB of archives.; "                                                                    \
  "echo After this operation, 1,388 MB of additional disk space will be used.; exit 1;; "                    \
  "*Status-Fd=3*) echo dlstatus:1:50.1:a >&3; echo pmstatus:b:40.0:c >&3; echo E: broken: by chance; "       \
  "exit ${APT:-0};; esac'; "

TEST(setup_prints_one_line_without_root_and_nothing_where_nothing_is_missing) {
  static const struct {
    const char *who, *packages, *text;
    int status;
  } row[] = {
      {"stand_in id 'echo 0'", "g++", "", 0},
      {"stand_in id 'echo 1000'; stand_in sudo 'exit 1'", "g++", "", 0},
      {"stand_in id 'echo 1000'; stand_in sudo 'exit 1'", "gnuplot g++ libcsv-dev",
       "sudo sh -c 'apt-get update && apt-get install -y --no-install-recommends gnuplot libcsv-dev'\n", 2},
      {"stand_in id 'echo 0'", "gnuplot",
       "to be installed: gnuplot\nwith what they need 2 packages: 31 kB to fetch, 1,388 MB on disk; some "
       "minutes\n"
       "  installing: 20 %\n  installing: 70 %\n",
       0},
      {"stand_in id 'echo 1000'; stand_in sudo '[ $1 = -n ] || \"$@\"'", "gnuplot",
       "to be installed: gnuplot\nwith what they need 2 packages: 31 kB to fetch, 1,388 MB on disk; some "
       "minutes\n"
       "  installing: 20 %\n  installing: 70 %\n",
       0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s: %s", row[i].who, row[i].packages);
    char line[2000], text[2000];
    snprintf(line, sizeof line, "here=$PWD; %s%s; PATH=.:$PATH O=o $here/tools/setup.sh %s 2>&1; exit $?",
             STAND_INS, row[i].who, row[i].packages);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == row[i].status);
    CHECK_TEXT(text, row[i].text);
  }
}

TEST(setup_says_why_apt_failed) {
  char text[2000];
  CHECK(program_run("here=$PWD; " STAND_INS
                    "stand_in id 'echo 0'; APT=100 TMPDIR=. PATH=.:$PATH O=o $here/tools/setup.sh gnuplot",
                    STREAM_ERROR, text, sizeof text) == 1);
  CHECK(strstr(text, "E: broken: by chance\ncould not install gnuplot; the whole log is in ") != NULL);
}
