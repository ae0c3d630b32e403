// scratch.h - small files for tests, in a folder that is removed at the end.
#ifndef TEST_RIG_SCRATCH_H
#define TEST_RIG_SCRATCH_H

// Writes the text to a file of that name; returns its path, valid until the next call. size -1: strlen.
const char *scratch_file(const char *name, const char *text, long size);

// The path of that name, valid until the next call; nothing is written.
const char *scratch_path(const char *name);

// The contents of the file of that name, up to 1 MiB; empty if there is none. Free it.
char *scratch_text(const char *name);

// The text without the scratch folder's path in front.
const char *scratch_short(const char *text);

#endif
