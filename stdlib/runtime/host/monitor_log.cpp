// SPDX-License-Identifier: Apache-2.0
// What the program has said: see monitor_log.h.
#include "monitor_log.h"

#include <mutex>

#include "json.h"
#include "trace.h"

namespace rung::host {
namespace {

constexpr size_t kMostMessages = 1000, kMostFaults = 100;
constexpr size_t kLongestText = 8000;

template <class Entry>
void keep(std::deque<Entry>& list, Entry entry, size_t most) {
  if (entry.text.size() > kLongestText) entry.text.resize(kLongestText);
  while (!entry.text.empty() && entry.text.back() == '\n') entry.text.pop_back();
  if (list.size() == most) list.pop_front();
  list.push_back(std::move(entry));
}

}  // namespace

void MonitorLog::addMessage(int64_t time_ns, const char* severity, std::string text) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  keep(messages_, {time_ns, severity, std::move(text)}, kMostMessages);
}

void MonitorLog::addFault(int64_t time_ns, int64_t cycle, std::string text) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  keep(faults_, {time_ns, cycle, std::move(text)}, kMostFaults);
}

std::string MonitorLog::messages() {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  std::string json = "[";
  for (const Message& message : messages_) {
    json += json.size() > 1 ? ",{\"time_ms\":" : "{\"time_ms\":";
    json += millisecondsOf(message.time_ns) + ",\"severity\":\"" + message.severity + "\",\"text\":";
    appendJsonText(json, message.text);
    json += '}';
  }
  return json += ']';
}

std::string MonitorLog::faults() {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  std::string json;
  for (const Fault& fault : faults_) {
    json += json.empty() ? "{\"time_ms\":" : ",{\"time_ms\":";
    json += millisecondsOf(fault.time_ns) + ",\"cycle\":" + std::to_string(fault.cycle) + ",\"text\":";
    appendJsonText(json, fault.text);
    json += '}';
  }
  return json;
}

}  // namespace rung::host
