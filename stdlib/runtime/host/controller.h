// SPDX-License-Identifier: Apache-2.0
// A program asks and sets this of the controller that runs it: the clock, the addresses of the Ethernet ports,
// current faults. All of it is simulated: nothing changes on this machine. In: calls of the program. Out: the services
// of a rung_host. Calls may come from several tasks. Called by session.cpp.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include "rung/diagnosis.h"
#include "state_archive.h"

namespace rung::host {

class Controller {
 public:
  // `clock_ns` is the clock that the program has not set.
  int64_t clock(int64_t clock_ns) const { return clock_ns + ahead_ns_.load(std::memory_order_relaxed); }
  bool setClock(int64_t clock_ns, int64_t wanted_ns);

  bool network(uint32_t port, rung_network& addresses);
  bool setNetwork(uint32_t port, const rung_network& addresses);

  rung_diagnosis& diagnosis() { return diagnosis_; }
  // A line for each current fault.
  std::string faults() const;
  // As it is when it is switched on.
  void reset();
  void transfer(StateArchive& archive);

 private:
  static constexpr uint32_t kPorts = 2;
  std::atomic<int64_t> ahead_ns_{0};  // of the clock that the program set
  std::mutex mutex_;                  // guards the ports
  // The factory setting of AX 2.2, and a segment that is not that of its USB network, 192.168.2.
  static constexpr rung_network kFactorySetting[kPorts] = {{0xc0a8010a, 0xffffff00, 0xc0a80101},
                                                           {0xc0a8030a, 0xffffff00, 0xc0a80301}};
  rung_network ports_[kPorts] = {kFactorySetting[0], kFactorySetting[1]};
  rung_diagnosis diagnosis_{};
};

}  // namespace rung::host
