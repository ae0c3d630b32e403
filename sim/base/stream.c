// stream.c - opens files that may be compressed by gzip.
#include "base/stream.h"

#include "base/gunzip.h"
#include <errno.h>
#include <string.h>

int stream_peek(FILE *stream) {
  const int first = getc(stream);
  if (first != EOF) ungetc(first, stream);
  return first;
}

done_t stream_open(FILE **stream, const char *path, why_t *why) {
  *stream = fopen(path, "rb");
  if (!*stream) return error_set(why, "%s: cannot be opened: %s", path, strerror(errno));
  errno = 0;
  const int first = stream_peek(*stream);
  if (ferror(*stream)) { // it is a folder
    const int cause = errno;
    fclose(*stream);
    *stream = NULL;
    return error_set(why, "%s: cannot be read: %s", path, strerror(cause));
  }
  if (first != GUNZIP_MAGIC) return DONE;
  *stream = gunzip_open(*stream);
  return *stream ? DONE : error_failed(why, "%s: out of memory", path);
}
