// SPDX-License-Identifier: Apache-2.0
// Progress on a terminal: see progress.h.
#include "progress.h"

#include <unistd.h>
#include <algorithm>

#include "clock.h"

namespace rung::host {
namespace {
constexpr int64_t kFirstNs = 2'000'000'000, kNextNs = 500'000'000;
}

Progress::Progress(std::FILE* out, int64_t cycles)
    : out_(out), cycles_(cycles), next_ns_(isatty(fileno(out)) != 0 ? monotonicNs() + kFirstNs : INT64_MAX) {}

void Progress::showOnTerminal(int64_t cycle) {
  const int64_t now = monotonicNs();
  if (now < next_ns_) return;
  next_ns_ = now + kNextNs;
  is_shown_ = true;
  const double percent = 100.0 * static_cast<double>(cycle + 1) / static_cast<double>(std::max<int64_t>(cycles_, 1));
  fprintf(out_, "\rcycle %lld of %lld (%.0f %%)\033[K", static_cast<long long>(cycle + 1),
          static_cast<long long>(cycles_), percent);
  fflush(out_);
}

void Progress::clear() {
  if (is_shown_) fputs("\r\033[K", out_);
  is_shown_ = false;
}

}  // namespace rung::host
