// SPDX-License-Identifier: Apache-2.0
// The rung of the archive for any Linux is linked statically. Such a program cannot load code: what would try finds
// these functions in place of those of the C library and gets an error.
#include "tools/driver/module_library.h"

namespace rung::driver {

bool loadsCode() { return false; }

}  // namespace rung::driver

extern "C" {

void* dlopen(const char*, int) { return nullptr; }
void* dlsym(void*, const char*) { return nullptr; }
int dlclose(void*) { return 0; }
char* dlerror() {
  static char text[] =
      "this rung is one file that loads no others; use the Debian package, or the program that `rung build` makes";
  return text;
}

}  // extern "C"
