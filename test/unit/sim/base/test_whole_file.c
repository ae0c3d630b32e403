// test_whole_file.c - what a program writes: all of it or nothing, and nobody else's file.
#define _DEFAULT_SOURCE // mknod, symlink, umask
#include "base/whole_file.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *content(const char *name) {
  static char text[200];
  FILE *file = fopen(scratch_path(name), "r");
  if (!file) return "(none)";
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  return text;
}

static void link_to(const char *target, const char *name) {
  unlink(scratch_path(name));
  CHECK(symlink(target, scratch_path(name)) == 0);
}

static done_t write_one(const char *name, const char *text, why_t *why) {
  whole_files_t w = {.n = 0};
  FILE *file;
  TRY(whole_files_open(&w, scratch_path(name), &file, why));
  fputs(text, file);
  return whole_files_commit(&w, why);
}

TEST(whole_files_take_the_place_of_a_file_and_of_nothing_else) {
  static const struct {
    const char *what, *name, *lands_in;
  } row[] = {
      {"nothing there", "w_new", "w_new"},
      {"a file", "w_old", "w_old"},
      {"a folder's link", "w_room/w_in", "w_in"},
  };
  scratch_file("w_old", "old", -1);
  scratch_file("w_in", "old", -1);
  link_to(".", "w_room");
  // A user's own file must not be where ours is written.
  scratch_file("w_new.part", "mine", -1);
  scratch_file("w_old.part", "mine", -1);
  char before[4000], after[4000];
  scratch_file("w_new", "", -1);
  program_listing(before, sizeof before);
  unlink(scratch_path("w_new"));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    why_t why = {""};
    CHECK_OK(write_one(row[i].name, row[i].what, &why));
    CHECK_TEXT(why.text, "");
    CHECK_TEXT(content(row[i].lands_in), row[i].what);
  }
  CHECK_TEXT(content("w_new.part"), "mine");
  CHECK_TEXT(content("w_old.part"), "mine");
  program_listing(after, sizeof after);
  CHECK_TEXT(after, before);
}

TEST(whole_files_have_the_rights_that_files_have) {
  why_t why;
  const mode_t mask = umask(027);
  scratch_file("w_rights", "old", -1);
  CHECK(chmod(scratch_path("w_rights"), 0604) == 0);
  CHECK_OK(write_one("w_rights", "new", &why));
  CHECK_OK(write_one("w_fresh", "new", &why));
  umask(mask);
  struct stat s;
  CHECK(stat(scratch_path("w_rights"), &s) == 0 && (s.st_mode & 0777) == 0604);
  CHECK(stat(scratch_path("w_fresh"), &s) == 0 && (s.st_mode & 0777) == 0640);
}

TEST(whole_files_write_into_a_pipe) {
  CHECK(mkfifo(scratch_path("w_pipe"), 0600) == 0);
  const int end = open(scratch_path("w_pipe"), O_RDONLY | O_NONBLOCK);
  if (!CHECK(end >= 0)) return;
  why_t why = {""};
  char text[40] = "";
  whole_files_t w = {.n = 0};
  FILE *file;
  CHECK_OK(whole_files_open(&w, scratch_path("w_pipe"), &file, &why));
  fputs("given up", file);
  whole_files_drop(&w);
  CHECK(read(end, text, sizeof text - 1) <= 0);
  CHECK_OK(write_one("w_pipe", "through", &why));
  CHECK(read(end, text, sizeof text - 1) == 7);
  CHECK_TEXT(text, "through");
  struct stat s;
  CHECK(stat(scratch_path("w_pipe"), &s) == 0 && S_ISFIFO(s.st_mode));
  close(end);
}

TEST(whole_files_leave_a_device_a_device) {
  // A null device of our own: one that is destroyed here hurts nobody.
  const char *path = scratch_path("w_null");
  if (mknod(path, S_IFCHR | 0666, (dev_t)((1 << 8) | 3)) != 0) SKIP("only root may make a device");
  FILE *device = fopen(path, "w");
  if (!device) SKIP("no devices in the scratch folder");
  fclose(device);
  why_t why = {""};
  CHECK_OK(write_one("w_null", "nothing", &why));
  CHECK_TEXT(why.text, "");
  struct stat s;
  CHECK(stat(scratch_path("w_null"), &s) == 0 && S_ISCHR(s.st_mode));
}

#define LINK_REFUSED "a symbolic link; allowed: a file, or a name that is not taken"

// Somebody may put a link there between the opening and the end.
TEST(whole_files_replace_a_link_that_comes_in_between) {
  whole_files_t w = {.n = 0};
  why_t why = {""};
  FILE *file;
  scratch_file("w_mine", "mine", -1);
  CHECK_OK(whole_files_open(&w, scratch_path("w_late"), &file, &why));
  fputs("new", file);
  link_to("w_mine", "w_late");
  CHECK_OK(whole_files_commit(&w, &why));
  CHECK_TEXT(content("w_mine"), "mine");
  CHECK_TEXT(content("w_late"), "new");
}

TEST(whole_files_go_through_a_link_to_a_device) {
  why_t why = {""};
  link_to("/dev/null", "w_device");
  CHECK_OK(write_one("w_device", "nothing", &why));
  struct stat s;
  CHECK(lstat(scratch_path("w_device"), &s) == 0 && S_ISLNK(s.st_mode));
}

TEST(whole_files_refuse_what_is_no_place_for_a_file) {
  static const struct {
    const char *first, *second, *line;
  } row[] = {
      {"w_a", "w_dir", "w_dir: a folder; allowed: a file"},
      {"w_a", "w_nowhere", "w_nowhere: " LINK_REFUSED},
      {"w_a", "w_way", "w_way: " LINK_REFUSED},
      {"w_a", "w_way2", "w_way2: " LINK_REFUSED},
      {"w_a", "w_way_room/w_way", "w_way_room/w_way: " LINK_REFUSED},
      {"w_a", "w_none/x", "w_none/x: cannot be written: No such file or directory"},
      {"w_a", "w_none/", "w_none/: cannot be written: No such file or directory"},
      {"w_a", "w_there/x", "w_there/x: cannot be written: Not a directory"},
      {"w_a", "w_a", "w_a: to be written twice; allowed: a file for each output"},
      {"w_a", "w_dir/../w_a", "w_dir/../w_a: to be written twice; allowed: a file for each output"},
      {"w_there", "w_way_room/w_there",
       "w_way_room/w_there: to be written twice; allowed: a file for each output"},
  };
  CHECK(mkdir(scratch_path("w_dir"), 0700) == 0);
  scratch_file("w_there", "old", -1);
  link_to("w_nothing", "w_nowhere");
  link_to("w_there", "w_way");
  link_to("w_way", "w_way2");
  link_to(".", "w_way_room");
  char before[4000], after[4000];
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s and %s", row[i].first, row[i].second);
    whole_files_t w = {.n = 0};
    why_t why = {""};
    FILE *file;
    CHECK_OK(whole_files_open(&w, scratch_path(row[i].first), &file, &why));
    CHECK_STATUS(BAD_INPUT, whole_files_open(&w, scratch_path(row[i].second), &file, &why));
    CHECK_TEXT(scratch_short(why.text), row[i].line);
    whole_files_drop(&w);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
  CHECK_TEXT(content("w_there"), "old");
}

TEST(whole_files_spare_what_is_read) {
  whole_files_t w = {.n = 0};
  why_t why = {""};
  FILE *file;
  scratch_file("w_read", "old", -1);
  link_to("w_read", "w_alias");
  CHECK_OK(whole_files_open(&w, scratch_path("w_read"), &file, &why));
  CHECK_STATUS(BAD_INPUT, whole_files_spare(&w, scratch_path("w_alias"), &why));
  CHECK_TEXT(scratch_short(why.text), "w_alias: to be read and to be written; allowed: one of them");
  CHECK_OK(whole_files_spare(&w, scratch_path("w_other"), &why));
  CHECK_OK(whole_files_spare(&w, NULL, &why));
  whole_files_drop(&w);
  CHECK_TEXT(content("w_read"), "old");
}

TEST(whole_files_are_all_there_or_none) {
  static const char *const names[] = {"w_one", "w_two", "w_three"};
  for (int broken = 0; broken < 3; broken++) {
    ROW("%s cannot be written", names[broken]);
    whole_files_t w = {.n = 0};
    why_t why = {""};
    FILE *file[3];
    unlink(scratch_path("w_one"));
    scratch_file("w_two", "old", -1);
    unlink(scratch_path("w_three"));
    char before[4000], after[4000];
    program_listing(before, sizeof before);
    for (int i = 0; i < 3; i++) {
      CHECK_OK(whole_files_open(&w, scratch_path(names[i]), &file[i], &why));
      fputs("new", file[i]);
    }
    close(fileno(file[broken])); // as a disk that is full would, it fails when the text leaves the buffer
    CHECK_STATUS(FAILED, whole_files_commit(&w, &why));
    CHECK(strstr(why.text, names[broken]) && strstr(why.text, "cannot be written"));
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
    CHECK_TEXT(content("w_two"), "old");
  }
}
