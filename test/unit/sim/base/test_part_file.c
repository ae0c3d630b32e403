// test_part_file.c - a program that is ended, by whatever signal, leaves nothing beside its files.
#define _XOPEN_SOURCE 700 // fork
#include "base/part_file.h"
#include "base/whole_file.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// Waits until the program has a file without a name in the scratch folder.
#define UNTIL_OPEN                                                                                           \
  "i=0; until ls -l /proc/$p/fd 2>/dev/null | grep -q \"$S/.*(deleted)\" || [ $((i+=1)) -gt 1000 ]; "        \
  "do sleep 0.01; done; "

// Starts the program, waits, gives it the signal; the exit status is the program's. A shell's background
// programs ignore SIGINT: env gives them a fresh mind. The sanitizers would tell of a crash in their own way.
#define INTERRUPT                                                                                            \
  "export ASAN_OPTIONS=handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0 "                       \
  "UBSAN_OPTIONS=handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0; ulimit -c 0; "               \
  "env --default-signal fly close-flight --seeds 10000 --json $S/%s >/dev/null & p=$!; " UNTIL_OPEN          \
  "[ $i -lt 1000 ] && echo open; kill -%s $p; wait $p"

TEST(fly_that_is_ended_by_a_signal_leaves_nothing_beside) {
  static const struct {
    const char *signal, *file;
    int number;
  } row[] = {
      {"INT", "p_old", SIGINT},   {"TERM", "p_new", SIGTERM}, {"HUP", "p_old", SIGHUP},
      {"QUIT", "p_new", SIGQUIT}, {"ABRT", "p_new", SIGABRT}, {"ALRM", "p_new", SIGALRM},
      {"XFSZ", "p_new", SIGXFSZ}, {"XCPU", "p_new", SIGXCPU}, {"USR1", "p_new", SIGUSR1},
      {"SEGV", "p_old", SIGSEGV}, {"BUS", "p_new", SIGBUS},   {"FPE", "p_new", SIGFPE},
      {"ILL", "p_new", SIGILL},   {"KILL", "p_old", SIGKILL},
  };
  char before[4000], after[4000], line[1200], text[400];
  scratch_file("p_old", "old", -1);
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("SIG%s, %s", row[i].signal, row[i].file);
    snprintf(line, sizeof line, INTERRUPT, row[i].file, row[i].signal);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 128 + row[i].number);
    CHECK_TEXT(text, "open\n");
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
  CHECK(program_run("cat $S/p_old", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, "old");
}

TEST(fly_that_may_write_no_more_leaves_nothing_beside) {
  char before[4000], after[4000], text[400];
  program_listing(before, sizeof before);
  CHECK(program_run("ulimit -c 0; " PROGRAM_DISK_FULL
                    "env --default-signal fly appendix-a --log $S/p_full.csv",
                    STREAM_OUTPUT, text, sizeof text) == 128 + SIGXFSZ);
  program_listing(after, sizeof after);
  CHECK_TEXT(after, before);
}

TEST(fly_goes_on_where_a_signal_is_ignored) {
  char text[400];
  CHECK(program_run("(trap '' HUP; exec fly close-flight --integrator rk4 --seeds 5 --json $S/p_hup) "
                    ">/dev/null & p=$!; " UNTIL_OPEN "kill -HUP $p; wait $p",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(program_run("tail -c 2 $S/p_hup; ls -A $S | grep -c '^[.]part-'", STREAM_OUTPUT, text, sizeof text) ==
        1);
  CHECK_TEXT(text, "}\n0\n");
}

// A child that is told to end while its file has a name beside its place; it puts it there after that.
static int end_while_holding(int number) {
  char folder[300], part[300], place[300];
  snprintf(folder, sizeof folder, "%s", scratch_path(""));
  snprintf(part, sizeof part, "%s", scratch_path(".p_part-XXXXXX"));
  snprintf(place, sizeof place, "%s", scratch_path("p_held"));
  const pid_t child = fork();
  if (child == 0) {
    part_t p;
    signal(number, SIG_DFL);
    if (!part_open(&p, folder) || write(p.file, "held", 4) != 4) _exit(1);
    part_hold();
    if (!part_name(&p, part)) _exit(2);
    raise(number);
    if (rename(part, place) != 0) _exit(3);
    part_release();
    _exit(4);
  }
  int status = 0;
  CHECK(child > 0 && waitpid(child, &status, 0) == child);
  return status;
}

TEST(part_files_hold_a_signal_until_all_is_done) {
  static const int number[] = {SIGTERM, SIGINT,  SIGHUP,  SIGQUIT, SIGABRT, SIGALRM,
                               SIGPIPE, SIGXFSZ, SIGXCPU, SIGUSR1, SIGUSR2};
  char before[4000], after[4000];
  scratch_file("p_held", "", -1);
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof number / sizeof *number; i++) {
    ROW("signal %d", number[i]);
    unlink(scratch_path("p_held"));
    const int status = end_while_holding(number[i]);
    CHECK(WIFSIGNALED(status) && WTERMSIG(status) == number[i]);
    program_listing(after, sizeof after); // p_held is there again, and nothing else
    CHECK_TEXT(after, before);
  }
}

// By a link where there are files without a name; else by a copy.
TEST(part_files_get_a_name_with_or_without_the_file_system) {
  static const struct {
    const char *what;
    bool unlinked, linkable;
  } row[] = {{"linked", false, true}, {"no /proc", false, false}, {"its name was taken away", true, false}};
  char folder[300];
  snprintf(folder, sizeof folder, "%s", scratch_path(""));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    char before[4000], after[4000], name[300], text[40] = "";
    program_listing(before, sizeof before);
    part_t p;
    if (!CHECK(row[i].unlinked ? part_open_unlinked(&p, folder) : part_open(&p, folder))) continue;
    p.linkable = p.linkable && row[i].linkable;
    FILE *const file = fdopen(part_writer(&p), "w");
    if (!CHECK(file != NULL)) continue;
    CHECK(fchmod(p.file, 0604) == 0);
    for (int k = 0; k < 30000; k++) fprintf(file, "%09d\n", k); // more than one block
    CHECK(fclose(file) == 0);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
    snprintf(name, sizeof name, "%s", scratch_path(".p_name-XXXXXX"));
    CHECK(part_name(&p, name));
    part_close(&p);
    struct stat s;
    CHECK(stat(name, &s) == 0 && s.st_size == 300000 && (s.st_mode & 0777) == 0604);
    FILE *const again = fopen(name, "r");
    if (CHECK(again != NULL)) {
      CHECK(fseek(again, -10, SEEK_END) == 0 && fgets(text, sizeof text, again));
      fclose(again);
    }
    CHECK_TEXT(text, "000029999\n");
    CHECK(unlink(name) == 0);
  }
}

TEST(part_files_say_where_they_cannot_be) {
  part_t p;
  char name[300], folder[300];
  CHECK(!part_open(&p, scratch_path("p_none/")) && p.file < 0);
  CHECK(!part_open_unlinked(&p, scratch_path("p_none/")) && p.file < 0);
  // Where the name cannot be given, there is no file.
  for (int linkable = 0; linkable < 2; linkable++) {
    ROW("linkable %d", linkable);
    snprintf(folder, sizeof folder, "%s", scratch_path(""));
    if (!CHECK(part_open(&p, folder))) return;
    p.linkable = p.linkable && linkable;
    snprintf(name, sizeof name, "%s", scratch_path("p_none/.p_name-XXXXXX"));
    CHECK(!part_name(&p, name));
    part_close(&p);
  }
}

TEST(whole_files_are_all_there_where_the_file_system_cannot_link) {
  whole_files_t w = {.n = 0};
  why_t why = {""};
  char before[4000], after[4000];
  scratch_file("p_one", "old", -1);
  scratch_file("p_two", "", -1);
  program_listing(before, sizeof before);
  unlink(scratch_path("p_two"));
  FILE *file[2];
  CHECK_OK(whole_files_open(&w, scratch_path("p_one"), &file[0], &why));
  CHECK_OK(whole_files_open(&w, scratch_path("p_two"), &file[1], &why));
  for (int i = 0; i < 2; i++) {
    w.of[i].part.linkable = false;
    fputs("new", file[i]);
  }
  CHECK_OK(whole_files_commit(&w, &why));
  program_listing(after, sizeof after);
  CHECK_TEXT(after, before);
  for (int i = 0; i < 2; i++) {
    char *const text = scratch_text(i ? "p_two" : "p_one");
    CHECK_TEXT(text, "new");
    free(text);
  }
}
