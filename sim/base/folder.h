// folder.h - splits a path into folder and file name. Header only.
#ifndef SIM_BASE_FOLDER_H
#define SIM_BASE_FOLDER_H

#include <string.h>

// The length in bytes of the path's folder with its last slash; 0 if the path names no folder.
static inline int folder_size(const char *path) {
  const char *const slash = strrchr(path, '/');
  return slash ? (int)(slash - path) + 1 : 0;
}

// The file name: the rest of the path.
static inline const char *folder_file(const char *path) {
  return path + folder_size(path);
}

#endif
