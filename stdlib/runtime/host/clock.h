// SPDX-License-Identifier: Apache-2.0
// The monotonic clock of the host: nanoseconds that no one sets. Called by whatever waits, paces or measures in real
// time.
#pragma once

#include <cstdint>
#include <ctime>

namespace rung::host {

inline int64_t monotonicNs() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * int64_t{1'000'000'000} + now.tv_nsec;
}

}  // namespace rung::host
