// gunzip.h - a stream of what a gzip file holds.
#ifndef SIM_BASE_GUNZIP_H
#define SIM_BASE_GUNZIP_H

#include <stdio.h>

#define GUNZIP_MAGIC 0x1F // its first byte

// Reads `packed` from where it stands (files joined by `cat` too) and is closed with it, also where this
// fails. A file that is cut off ends where it is cut; a damaged one makes the stream's reads fail. Null: no
// memory.
FILE *gunzip_open(FILE *packed);

#endif
