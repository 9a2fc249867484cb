// SPDX-License-Identifier: Apache-2.0
// What the program has said since its start, for clients of the monitor: messages and faults, the last ones of them.
// In: texts from any thread. Out: arrays of JSON.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "priority_mutex.h"

namespace rung::host {

class MonitorLog {
 public:
  // `severity`: note, warning or error.
  void addMessage(int64_t time_ns, const char* severity, std::string text);
  // Several lines: the fault, and the calls that led to it.
  void addFault(int64_t time_ns, int64_t cycle, std::string text);
  std::string messages();
  // Without the brackets, for more to be added.
  std::string faults();

 private:
  struct Message {
    int64_t time_ns;
    const char* severity;
    std::string text;
  };
  struct Fault {
    int64_t time_ns, cycle;
    std::string text;
  };
  PriorityMutex mutex_;
  std::deque<Message> messages_;
  std::deque<Fault> faults_;
};

}  // namespace rung::host
