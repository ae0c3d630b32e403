// part_file.c - files that have no name until they are complete.
#define _GNU_SOURCE // O_TMPFILE
#include "base/part_file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PATH_BYTES 4200
#define LINK_BYTES 40 // enough for "/proc/self/fd/" and a number
#define TRIES      100

// --- signals ------------------------------------------------------------------------------------------

// All signals that end a process by default and can be deferred; crashes (SIGSEGV ..) cannot.
static const int SIGNALS[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGABRT, SIGPIPE,   SIGALRM, SIGTERM, SIGUSR1,
                              SIGUSR2, SIGXCPU, SIGXFSZ, SIGPROF, SIGVTALRM, SIGIO,   SIGPWR};
#define SIGNALS_ALL ((int)(sizeof SIGNALS / sizeof *SIGNALS))

static volatile sig_atomic_t waiting[SIGNALS_ALL];
static bool ours[SIGNALS_ALL];

static void note(int number) {
  for (int i = 0; i < SIGNALS_ALL; i++)
    if (SIGNALS[i] == number) waiting[i] = 1;
}

void part_hold(void) {
  for (int i = 0; i < SIGNALS_ALL; i++) {
    struct sigaction old, hold = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigemptyset(&hold.sa_mask);
    ours[i] = sigaction(SIGNALS[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL;
    if (ours[i]) sigaction(SIGNALS[i], &hold, NULL);
  }
}

void part_release(void) {
  for (int i = 0; i < SIGNALS_ALL; i++)
    if (ours[i]) signal(SIGNALS[i], SIG_DFL);
  for (int i = 0; i < SIGNALS_ALL; i++) {
    if (waiting[i]) raise(SIGNALS[i]);
    waiting[i] = 0;
  }
}

// --- files --------------------------------------------------------------------------------------------

static const char *own_link(const part_t *p, char text[LINK_BYTES]) {
  snprintf(text, LINK_BYTES, "/proc/self/fd/%d", p->file);
  return text;
}

bool part_open_unlinked(part_t *p, const char *folder) {
  char name[PATH_BYTES];
  *p = (part_t){.file = -1};
  if (snprintf(name, sizeof name, "%s/.part-XXXXXX", folder) >= (int)sizeof name) {
    errno = ENAMETOOLONG;
    return false;
  }
  part_hold();
  p->file = mkostemp(name, O_CLOEXEC);
  if (p->file >= 0) unlink(name);
  part_release();
  return p->file >= 0;
}

bool part_open(part_t *p, const char *folder) {
  char text[LINK_BYTES];
  struct stat s;
  p->file = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  // A file gets its name through /proc, which a minimal root file system may lack.
  p->linkable = p->file >= 0 && stat(own_link(p, text), &s) == 0;
  if (p->file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return p->file >= 0;
  return part_open_unlinked(p, folder);
}

int part_writer(const part_t *p) {
  return fcntl(p->file, F_DUPFD_CLOEXEC, 0);
}

// Draws the last letters of the name from process id and attempt.
static void draw(char *tail, int attempt) {
  static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  unsigned long number = (unsigned long)getpid() * TRIES + (unsigned long)attempt;
  for (int i = 0; i < 6; i++, number /= sizeof letters - 1) tail[i] = letters[number % (sizeof letters - 1)];
}

static bool link_to(const part_t *p, char *name) {
  char text[LINK_BYTES];
  for (int i = 0; i < TRIES; i++) {
    draw(name + strlen(name) - 6, i);
    if (linkat(AT_FDCWD, own_link(p, text), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0) return true;
    if (errno != EEXIST) return false;
  }
  return false;
}

static bool copy(int from, int to) {
  char block[65536];
  off_t at = 0;
  for (ssize_t n; (n = pread(from, block, sizeof block, at)) != 0; at += n) {
    if (n < 0) return false;
    for (ssize_t done = 0, more; done < n; done += more)
      if ((more = write(to, block + done, (size_t)(n - done))) < 0) return false;
  }
  return true;
}

static bool copy_to(const part_t *p, char *name) {
  struct stat s;
  const int file = fstat(p->file, &s) == 0 ? mkostemp(name, O_CLOEXEC) : -1;
  if (file < 0) return false;
  (void)!fchown(file, s.st_uid, s.st_gid); // only root may; other users keep their own ids
  bool good = fchmod(file, s.st_mode & 07777) == 0 && copy(p->file, file);
  if (close(file) != 0) good = false;
  if (good) return true;
  const int cause = errno;
  unlink(name);
  errno = cause;
  return false;
}

bool part_name(const part_t *p, char *name) {
  return p->linkable ? link_to(p, name) : copy_to(p, name);
}

void part_close(part_t *p) {
  if (p->file >= 0) close(p->file);
  p->file = -1;
}
