// version.h - what was built: "0.9.0 (commit 1fe0254f2d1c)"; + behind the commit: files differed from it.
#ifndef SIM_BASE_VERSION_H
#define SIM_BASE_VERSION_H

extern const char version_text[]; // tools/version.sh writes it

#endif
