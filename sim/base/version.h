// version.h - the version: "0.9.0 (commit 1fe0254f2d1c)"; a + after the commit: built from modified files.
#ifndef SIM_BASE_VERSION_H
#define SIM_BASE_VERSION_H

extern const char version_text[]; // tools/version.sh writes it

#endif
