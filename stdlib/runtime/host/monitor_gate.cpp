// SPDX-License-Identifier: Apache-2.0
// Between the monitor's server and the run: see monitor_gate.h.
#include "monitor_gate.h"

#include <sys/eventfd.h>
#include <unistd.h>
#include <algorithm>
#include <mutex>

#include "clock.h"

namespace rung::host {
namespace {

constexpr int64_t kMostAtOnceNs = 1'000'000;  // of the run's time
constexpr int64_t kLongestWaitNs = 50'000'000;

}  // namespace

MonitorGate::MonitorGate() : wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

MonitorGate::~MonitorGate() {
  if (wake_ >= 0) close(wake_);
}

void MonitorGate::ask(Client client, Act act, int64_t now_ns) {
  {
    const std::lock_guard<PriorityMutex> lock(mutex_);
    questions_.push_back({client, std::move(act), now_ns});
    has_questions_.store(true, std::memory_order_relaxed);
  }
  wakeRun();
}

std::vector<MonitorGate::Answer> MonitorGate::takeAnswers() {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  return std::exchange(answers_, {});
}

std::vector<MonitorGate::Client> MonitorGate::takeOverdue(int64_t now_ns) {
  std::vector<Client> overdue;
  const std::lock_guard<PriorityMutex> lock(mutex_);
  for (; !questions_.empty() && now_ns - questions_.front().asked_ns >= kPatienceNs; questions_.pop_front())
    overdue.push_back(questions_.front().client);
  return overdue;
}

int64_t MonitorGate::nextOverdueNs() {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  return questions_.empty() ? INT64_MAX : questions_.front().asked_ns + kPatienceNs;
}

void MonitorGate::wakeRun() {
  const uint64_t once = 1;
  (void)!::write(wake_, &once, sizeof once);
}

bool MonitorGate::takeQuestion(Question& question) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  has_questions_.store(questions_.size() > 1, std::memory_order_relaxed);
  if (questions_.empty()) return false;
  question = std::move(questions_.front());
  questions_.pop_front();
  return true;
}

void MonitorGate::answer(Client client, Finish finish) {
  const std::lock_guard<PriorityMutex> lock(mutex_);
  answers_.push_back({client, std::move(finish)});
}

bool MonitorGate::answerSome(const std::function<bool()>& goes_on) {
  if (!has_questions_.load(std::memory_order_relaxed)) return false;
  bool has_answered = false;
  Question question;
  for (const int64_t end = monotonicNs() + kMostAtOnceNs; monotonicNs() < end && goes_on() && takeQuestion(question);) {
    if (Finish finish = question.act()) answer(question.client, std::move(finish));
    has_answered = true;
  }
  return has_answered;
}

void MonitorGate::waitUntil(int64_t monotonic_ns) {
  const int64_t wait = std::clamp<int64_t>(monotonic_ns - monotonicNs(), 0, kLongestWaitNs);
  const timespec time{0, static_cast<long>(wait)};
  pollfd wakes{wake_, POLLIN, 0};
  uint64_t times = 0;
  if (ppoll(&wakes, 1, &time, nullptr) > 0) (void)!::read(wake_, &times, sizeof times);
}

}  // namespace rung::host
