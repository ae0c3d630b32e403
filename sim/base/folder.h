// folder.h - where a path's folder ends. Header only.
#ifndef SIM_BASE_FOLDER_H
#define SIM_BASE_FOLDER_H

#include <string.h>

// How many bytes of the path are its folder, with the last slash; 0: there is none in it.
static inline int folder_size(const char *path) {
  const char *const slash = strrchr(path, '/');
  return slash ? (int)(slash - path) + 1 : 0;
}

// The file's own name: what stands behind it.
static inline const char *folder_file(const char *path) {
  return path + folder_size(path);
}

#endif
