// test_part_file.c - an interrupted program leaves nothing beside its files.
#define _XOPEN_SOURCE 700 // fork
#include "io/part_file.h"
#include "programs.h"
#include "scratch.h"
#include "test.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Starts the program, waits for its file, gives it the signal; the exit status is the program's. Prints what
// lay beside before. A shell's background programs ignore SIGINT: env gives them a fresh mind.
#define INTERRUPT                                                                                            \
  "%s >/dev/null & p=$!; i=0; until ls -A $S | grep '^[.]part-' || [ $((i+=1)) -gt 1000 ]; do sleep 0.01; "  \
  "done | sed 's/-.*/-/'; kill -%s $p; wait $p"

TEST(fly_that_is_interrupted_leaves_nothing_beside) {
  static const struct {
    const char *line, *signal;
    int status; // 128 and the number: the program was ended by the signal
  } row[] = {
      {"env --default-signal fly close-flight --seeds 10000 --json $S/p_old", "INT", 130},
      {"env --default-signal fly close-flight --seeds 10000 --json $S/p_new", "TERM", 143},
      {"env --default-signal fly close-flight --seeds 10000 --json $S/p_old", "HUP", 129},
      {"env --default-signal fly close-flight --from 1 --to 1000000 --json $S/p_new", "INT", 130},
  };
  char before[4000], after[4000], line[800], text[400];
  scratch_file("p_old", "old", -1);
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s, %s", row[i].line, row[i].signal);
    snprintf(line, sizeof line, INTERRUPT, row[i].line, row[i].signal);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == row[i].status);
    CHECK_TEXT(text, ".part-\n");
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
  CHECK(program_run("cat $S/p_old", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, "old");
}

TEST(fly_goes_on_where_a_signal_is_ignored) {
  char text[400];
  CHECK(program_run(
            "(trap '' HUP; fly close-flight --integrator rk4 --seeds 5 --json $S/p_hup) >/dev/null & p=$!; "
            "i=0; until ls -A $S | grep -q '^[.]part-' || [ $((i+=1)) -gt 1000 ]; do sleep 0.01; done; "
            "kill -HUP $p; wait $p",
            STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(program_run("tail -c 2 $S/p_hup; ls -A $S | grep -c '^[.]part-'", STREAM_OUTPUT, text, sizeof text) ==
        1);
  CHECK_TEXT(text, "}\n0\n");
}

// A child that is told to end while it holds, and writes a file after that.
static int end_while_holding(void) {
  char part[300], after[300];
  snprintf(after, sizeof after, "%s", scratch_path("p_after"));
  snprintf(part, sizeof part, "%s", scratch_path(".p_part-XXXXXX"));
  const pid_t child = fork();
  if (child == 0) {
    if (part_file_open(part) < 0) _exit(1);
    part_hold();
    raise(SIGTERM);
    FILE *const file = fopen(after, "w");
    if (!file || fclose(file) != 0) _exit(2);
    part_release();
    _exit(3);
  }
  int status = 0;
  CHECK(child > 0 && waitpid(child, &status, 0) == child);
  return status;
}

TEST(part_files_hold_a_signal_until_all_is_done) {
  char before[4000], after[4000];
  scratch_file("p_after", "", -1);
  program_listing(before, sizeof before);
  unlink(scratch_path("p_after"));
  const int status = end_while_holding();
  CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  program_listing(after, sizeof after); // p_after is there again, the part is not
  CHECK_TEXT(after, before);
}

TEST(part_files_have_an_end) {
  static char name[PART_FILES_MAX + 1][300];
  int n = 0;
  for (int i = 0; i <= PART_FILES_MAX; i++) {
    snprintf(name[i], sizeof name[i], "%s", scratch_path(".p_many-XXXXXX"));
    const int file = part_file_open(name[i]);
    if (file < 0) break;
    close(file);
    n++;
  }
  CHECK(n == PART_FILES_MAX);
  for (int i = 0; i < n; i++) part_file_remove(name[i]);
  CHECK(part_file_open(strcpy(name[0], scratch_path(".p_again-XXXXXX"))) >= 0);
  CHECK(part_file_move(name[0], scratch_path("p_again")));
  CHECK(!part_file_move(name[0], scratch_path("p_again")));
}
