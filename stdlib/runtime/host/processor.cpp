// SPDX-License-Identifier: Apache-2.0
// Priorities and processors: see processor.h.
#include "processor.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <algorithm>
#include <vector>

namespace rung::host {
namespace {

constexpr int kHighest = 80, kAbove = 90;  // of SCHED_FIFO; below the kernel's own threads

std::vector<int> permittedCpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> all;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return {0};
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &set)) all.push_back(cpu);
  return all;
}

bool setPriority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace

Rights findRights() {
  Rights rights;
  sched_param before{};
  int policy = SCHED_OTHER;
  pthread_getschedparam(pthread_self(), &policy, &before);
  rights.preemptive = setPriority(1);
  pthread_setschedparam(pthread_self(), policy, &before);
  if (!rights.preemptive)
    rights.missing = "no right to use SCHED_FIFO: tasks of a resource run one at a time, without pre-emption";
  // Pages that are used stay in memory; those of stacks that are never used need none.
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
    rights.missing += std::string(rights.missing.empty() ? "" : "; ") + "no right to lock memory";
  rights.cpus = permittedCpus();
  return rights;
}

Scheduling::Scheduling() {
  pthread_getschedparam(pthread_self(), &policy_, &priority_);
  sched_getaffinity(0, sizeof cpus_, &cpus_);
}

void Scheduling::restore() const {
  pthread_setschedparam(pthread_self(), policy_, &priority_);
  sched_setaffinity(0, sizeof cpus_, &cpus_);
}

void yieldToTasks(uint32_t resources) {
  constexpr int kNiceness = 5;
  setpriority(PRIO_PROCESS, 0, kNiceness);  // of this thread
  const std::vector<int> cpus = permittedCpus();
  if (cpus.size() <= resources) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (size_t i = 0; i < cpus.size() - resources; ++i) CPU_SET(cpus[i], &set);
  sched_setaffinity(0, sizeof set, &set);
}

void Processor::prepare(uint32_t number, const Rights& rights) {
  const std::vector<int>& cpus = rights.cpus;
  preemptive_ = rights.preemptive;
  // From the last one: the first ones serve most interrupts.
  cpu_ = cpus[cpus.size() - 1 - number % cpus.size()];
}

void Processor::join(uint32_t priority, bool above) const {
  if (!preemptive_) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(cpu_, &set);
  sched_setaffinity(0, sizeof set, &set);
  setPriority(above ? kAbove : kHighest - 2 * static_cast<int>(std::min(priority, kPriorities - 1)));
}

void Processor::acquire(uint32_t priority) {
  if (preemptive_) return;
  priority = std::min(priority, kPriorities - 1);
  std::unique_lock<std::mutex> lock(mutex_);
  ++waiting_[priority];
  free_[priority].wait(lock, [&] {
    return !is_busy_ && std::all_of(waiting_, waiting_ + priority, [](uint32_t count) { return count == 0; });
  });
  --waiting_[priority];
  is_busy_ = true;
}

void Processor::release() {
  if (preemptive_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_busy_ = false;
  for (uint32_t i = 0; i < kPriorities; ++i) {
    if (waiting_[i] == 0) continue;
    free_[i].notify_one();
    return;
  }
}

}  // namespace rung::host
