// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/sink.h"

#include "tools/driver/installation.h"

namespace rung::driver {

void Sink::diagnostics(const Diagnostics& all, const Sources& sources, const RenderOptions& options) {
  message(render(all, sources, options));
}

void Sink::error(std::string_view what) { message("rung: error: " + std::string(what) + "\n"); }

void Sink::internalError(std::string_view what) {
  message("rung: internal error: " + std::string(what) + "\nthis is a bug in rung " + version() +
          ", not in your program\n");
}

void Sink::progress(const char*, size_t, size_t) {}

void Sink::programRuns(bool, bool) {}

}  // namespace rung::driver
