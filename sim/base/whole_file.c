// whole_file.c - files that are complete or do not exist.
#define _XOPEN_SOURCE 700 // realpath, fchown
#include "base/whole_file.h"

#include "base/folder.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static done_t cannot(const char *path, why_t *why) {
  return error_set(why, "%.300s: cannot be written: %s", path, strerror(errno));
}

// The path with its folder free of links, so that two paths to one place compare equal. The last part must
// not be a link. False on an error, with errno set.
static bool resolve(const char *path, char target[WHOLE_PATH_MAX]) {
  char folder[WHOLE_PATH_MAX];
  const int size = folder_size(path);
  errno = ENOENT;
  if (path[size] == '\0') return false;
  if (snprintf(folder, sizeof folder, "%.*s", size, path) >= (int)sizeof folder) {
    errno = ENAMETOOLONG;
    return false;
  }
  char *const real = realpath(size ? folder : ".", NULL);
  if (!real) return false;
  const int used = snprintf(target, WHOLE_PATH_MAX, "%s%s%s", real, real[1] == '\0' ? "" : "/", path + size);
  free(real);
  if (used >= WHOLE_PATH_MAX) errno = ENAMETOOLONG;
  return used < WHOLE_PATH_MAX;
}

static bool is_output(const struct stat *s) {
  struct stat out;
  return fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == s->st_dev && out.st_ino == s->st_ino;
}

// The text is kept in a temporary file, because text sent into a pipe could not be taken back.
static done_t open_direct(whole_file_t *f, const char *path, const struct stat *s, why_t *why) {
  // If the file is the standard output, opening it a second time would overwrite what is printed.
  const int output = is_output(s) ? dup(STDOUT_FILENO) : -1;
  f->direct = output >= 0 ? fdopen(output, "w") : fopen(path, "w");
  if (!f->direct) return cannot(path, why);
  f->file = tmpfile();
  if (f->file) return DONE;
  fclose(f->direct);
  return error_failed(why, "no temporary file: %s", strerror(errno));
}

// there: the file to be replaced, whose owner and mode are kept; null if there is none.
static done_t open_beside(whole_file_t *f, const char *path, const struct stat *there, why_t *why) {
  // rename() would ignore the permissions of the file itself.
  if (there && access(f->target, W_OK) != 0) return cannot(path, why);
  char folder[WHOLE_PATH_MAX];
  const int size = folder_size(f->target);
  snprintf(folder, sizeof folder, "%.*s", size, f->target);
  if (!part_open(&f->part, folder)) return cannot(path, why);
  const mode_t mask = umask(0);
  umask(mask);
  if (there) (void)!fchown(f->part.file, there->st_uid, there->st_gid); // only root may; others keep theirs
  (void)!fchmod(f->part.file, there ? there->st_mode & 07777 : 0666 & ~mask);
  const int writer = part_writer(&f->part);
  f->file = writer < 0 ? NULL : fdopen(writer, "w");
  if (f->file) return DONE;
  if (writer >= 0) close(writer);
  part_close(&f->part);
  return error_failed(why, "%.300s: %s", path, strerror(errno));
}

static done_t open_one(whole_file_t *f, const char *path, why_t *why) {
  struct stat s, link;
  const bool there = stat(path, &s) == 0;
  if (!there && errno != ENOENT) return cannot(path, why);
  const bool linked = lstat(path, &link) == 0 && S_ISLNK(link.st_mode);
  if (there && S_ISDIR(s.st_mode)) return error_set(why, "%.300s: a folder; allowed: a file", path);
  const bool file = !there || (S_ISREG(s.st_mode) && !is_output(&s));
  if (linked && file)
    return error_set(why, "%.300s: a symbolic link; allowed: a file, or a name that is not taken", path);
  if (file && !resolve(path, f->target)) return cannot(path, why);
  if (file) return open_beside(f, path, there ? &s : NULL, why);
  char *const real = realpath(path, NULL); // fails for a link to a pipe of the shell
  snprintf(f->target, sizeof f->target, "%s", real ? real : path);
  free(real);
  return open_direct(f, path, &s, why);
}

done_t whole_files_open(whole_files_t *w, const char *path, FILE **file, why_t *why) {
  *file = NULL;
  if (!path) return DONE;
  if (w->n == WHOLE_FILES_MAX) return error_failed(why, "more than %d files to write", WHOLE_FILES_MAX);
  // If standard output is closed, a file would get its descriptor, and with it what is printed.
  struct stat output;
  if (fstat(STDOUT_FILENO, &output) != 0) return error_failed(why, "standard output: it is closed");
  whole_file_t *const f = &w->of[w->n];
  *f = (whole_file_t){.part = {.file = -1}};
  TRY(open_one(f, path, why));
  w->n++;
  for (int i = 0; i + 1 < w->n; i++)
    if (strcmp(w->of[i].target, f->target) == 0)
      return error_set(why, "%.300s: to be written twice; allowed: a file for each output", path);
  *file = f->file;
  return DONE;
}

done_t whole_files_spare(const whole_files_t *w, const char *path, why_t *why) {
  char *const real = path ? realpath(path, NULL) : NULL;
  bool written = false;
  for (int i = 0; real && i < w->n; i++)
    written = written || (!w->of[i].direct && strcmp(w->of[i].target, real) == 0);
  free(real);
  return written ? error_set(why, "%.300s: to be read and to be written; allowed: one of them", path) : DONE;
}

static bool copy(FILE *from, FILE *to) {
  char block[4096];
  rewind(from);
  for (size_t n; (n = fread(block, 1, sizeof block, from)) > 0;)
    if (fwrite(block, 1, n, to) != n) return false;
  return !ferror(from);
}

static void close_file(FILE **file, bool *good) {
  if (!*file) return;
  const bool written = !ferror(*file);
  const bool closed = fclose(*file) == 0;
  *good = *good && written && closed;
  *file = NULL;
}

static done_t not_written(const whole_file_t *f, why_t *why) {
  return error_failed(why, "%.300s: cannot be written: %s", f->target, strerror(errno));
}

static done_t finish(whole_file_t *f, why_t *why) {
  errno = EIO;
  bool good = fflush(f->file) == 0 && !ferror(f->file);
  if (good && f->direct) good = copy(f->file, f->direct);
  close_file(&f->file, &good);
  close_file(&f->direct, &good);
  return good ? DONE : not_written(f, why);
}

// After this step, no common error can occur any more.
static done_t name(whole_file_t *f, why_t *why) {
  if (f->part.file < 0) return DONE;
  static const char own[] = ".part-XXXXXX";
  const size_t folder = (size_t)folder_size(f->target);
  if (folder + sizeof own <= sizeof f->beside) {
    memcpy(f->beside, f->target, folder);
    memcpy(f->beside + folder, own, sizeof own);
    if (part_name(&f->part, f->beside)) return DONE;
  }
  f->beside[0] = '\0';
  return not_written(f, why);
}

static done_t move(whole_file_t *f, why_t *why) {
  if (f->beside[0] == '\0') return DONE;
  if (rename(f->beside, f->target) != 0) return not_written(f, why);
  f->beside[0] = '\0';
  return DONE;
}

done_t whole_files_commit(whole_files_t *w, why_t *why) {
  done_t status = DONE;
  if (fflush(stdout) != 0 || ferror(stdout)) status = error_failed(why, "standard output: cannot be written");
  // Files first: text sent into a pipe could not be taken back.
  for (int i = 0; i < w->n && status == DONE; i++)
    if (!w->of[i].direct) status = finish(&w->of[i], why);
  for (int i = 0; i < w->n && status == DONE; i++)
    if (w->of[i].direct) status = finish(&w->of[i], why);
  part_hold(); // all files or none
  for (int i = 0; i < w->n && status == DONE; i++) status = name(&w->of[i], why);
  for (int i = 0; i < w->n && status == DONE; i++) status = move(&w->of[i], why);
  whole_files_drop(w);
  part_release();
  return status;
}

void whole_files_drop(whole_files_t *w) {
  for (int i = 0; i < w->n; i++) {
    bool good = true;
    close_file(&w->of[i].file, &good);
    close_file(&w->of[i].direct, &good);
    if (w->of[i].beside[0]) unlink(w->of[i].beside);
    part_close(&w->of[i].part);
  }
  w->n = 0;
}

int whole_files_exit(whole_files_t *w, const char *program, done_t status, why_t *why) {
  if (status == DONE) status = whole_files_commit(w, why);
  whole_files_drop(w);
  return error_exit(program, status, why);
}
