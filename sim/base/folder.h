// folder.h - where a path's folder ends. Header only.
#ifndef SIM_BASE_FOLDER_H
#define SIM_BASE_FOLDER_H

#include <string.h>

// How many bytes of the path are its folder, with the last slash; 0: there is none in it. What stands behind
// is the file's own name.
static inline int folder_size(const char *path) {
  const char *const slash = strrchr(path, '/');
  return slash ? (int)(slash - path) + 1 : 0;
}

static inline const char *folder_none(const char *path) {
  return path + folder_size(path);
}

#endif
