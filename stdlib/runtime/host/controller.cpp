// SPDX-License-Identifier: Apache-2.0
// The simulated controller: see controller.h.
#include "controller.h"

#include <algorithm>
#include <cstdio>

namespace rung::host {

bool Controller::setClock(int64_t clock_ns, int64_t wanted_ns) {
  if (wanted_ns < 0) return false;
  ahead_ns_.store(wanted_ns - clock_ns, std::memory_order_relaxed);
  return true;
}

bool Controller::network(uint32_t port, rung_network& addresses) {
  if (port < 1 || port > kPorts) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  addresses = ports_[port - 1];
  return true;
}

bool Controller::setNetwork(uint32_t port, const rung_network& addresses) {
  if (port < 1 || port > kPorts) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  ports_[port - 1] = addresses;
  return true;
}

void Controller::reset() {
  ahead_ns_.store(0);
  const std::lock_guard<std::mutex> lock(mutex_);
  std::copy_n(kFactorySetting, kPorts, ports_);
  diagnosis_ = {};
}

void Controller::transfer(StateArchive& archive) {
  int64_t ahead_ns = ahead_ns_.load();
  archive.value(ahead_ns);
  ahead_ns_.store(ahead_ns);
  const std::lock_guard<std::mutex> lock(mutex_);
  archive.values(ports_, diagnosis_);
}

std::string Controller::faults() const {
  rung_current_fault faults[RUNG_DIAGNOSIS_ENTRIES];
  const uint32_t count = rung_current_faults(&diagnosis_, faults, RUNG_DIAGNOSIS_ENTRIES);
  std::string text;
  for (uint32_t i = 0; i < count; ++i) {
    char line[96];
    snprintf(line, sizeof line, "fault 16#%X of source %u since %lld ms\n", faults[i].code, faults[i].source,
             static_cast<long long>(faults[i].since_ns / 1'000'000));
    text += line;
  }
  return text;
}

}  // namespace rung::host
