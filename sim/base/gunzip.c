// gunzip.c - a stream that decompresses a gzip file.
#define _GNU_SOURCE // fopencookie
#include "base/gunzip.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <zlib.h>

#define GZIP_WINDOW (15 + 16) // largest window, gzip header

typedef struct {
  FILE *packed;
  z_stream z;
  bool ended; // one of several joined files
  unsigned char in[1 << 14];
} gunzip_t;

static ssize_t read_some(void *cookie, char *to, size_t size) {
  gunzip_t *const g = cookie;
  g->z.next_out = (unsigned char *)to;
  g->z.avail_out = (unsigned)size;
  while (g->z.avail_out == size) {
    if (g->z.avail_in == 0) {
      g->z.next_in = g->in;
      g->z.avail_in = (unsigned)fread(g->in, 1, sizeof g->in, g->packed);
      if (g->z.avail_in == 0) return ferror(g->packed) ? -1 : 0;
    }
    if (g->ended && inflateReset(&g->z) != Z_OK) return -1;
    const int status = inflate(&g->z, Z_NO_FLUSH);
    g->ended = status == Z_STREAM_END;
    if (status == Z_OK || status == Z_STREAM_END || status == Z_BUF_ERROR) continue;
    errno = EIO;
    return -1;
  }
  return (ssize_t)(size - g->z.avail_out);
}

static int close_it(void *cookie) {
  gunzip_t *const g = cookie;
  inflateEnd(&g->z);
  const int status = fclose(g->packed);
  free(g);
  return status;
}

FILE *gunzip_open(FILE *packed) {
  gunzip_t *const g = calloc(1, sizeof *g);
  if (g && inflateInit2(&g->z, GZIP_WINDOW) == Z_OK) {
    g->packed = packed;
    FILE *const stream = fopencookie(g, "r", (cookie_io_functions_t){.read = read_some, .close = close_it});
    if (stream) return stream;
    inflateEnd(&g->z);
  }
  free(g);
  fclose(packed);
  return NULL;
}
