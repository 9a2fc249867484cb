// SPDX-License-Identifier: Apache-2.0
// Values for clients of the monitor: lists of variables, and copies of their values that all belong to one cycle. A
// copy is made by the thread that ends a cycle, which never waits for it; it is formatted by the thread of the server.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "symbols.h"

namespace rung::host {

class WatchList {
 public:
  static constexpr size_t kMost = 10'000;  // variables: a copy of them takes well below a millisecond
  // Elementary variables; of records and arrays what is in them. False: `error` says why not, with `is_unknown` where
  // the path is.
  bool add(const Symbols& symbols, const std::string& path, std::string& error, bool& is_unknown);
  // The same variables of another version of the program; those that it does not have have no value.
  WatchList movedTo(const Symbols& symbols) const;
  size_t bytes() const { return bytes_; }
  // Copies the values, where no activation changes them.
  void copy(uint8_t* to) const;
  // `"path":"value",…` of a copy; null where a pointer on the path was.
  void append(const LoadedModule& module, const uint8_t* copied, std::string& json) const;
  // The same as `path = value` lines.
  void appendLines(const LoadedModule& module, const uint8_t* copied, std::string& text) const;

 private:
  static size_t sizeOf(const Variable& variable) { return variable.type == nullptr ? 0 : variable.type->size; }
  // Of each variable and its value in a copy; null: there is none.
  template <class F>
  void each(const uint8_t* copied, F act) const {
    for (const Variable& variable : variables_) {
      act(variable, *copied != 0 ? copied + 1 : nullptr);
      copied += 1 + sizeOf(variable);
    }
  }

  std::vector<Variable> variables_;
  size_t bytes_ = 0;
};
using SharedList = std::shared_ptr<const WatchList>;

// The values that the server wants next. One thread wants and reads, another one takes.
class Sample {
 public:
  bool isIdle() const { return state_.load(std::memory_order_acquire) == State::Idle; }
  bool isWanted() const { return state_.load(std::memory_order_relaxed) == State::Wanted; }
  bool isTaken() const { return state_.load(std::memory_order_acquire) == State::Taken; }
  int64_t wantedSince() const { return wanted_ns_.load(std::memory_order_relaxed); }
  // While idle.
  void want(std::vector<SharedList> lists, int64_t now_ns);
  // While wanted. Tells whether it was.
  bool take(int64_t cycle, int64_t time_ns);
  // While taken; then it is idle again.
  const uint8_t* values(size_t list) const { return copies_[list].data(); }
  int64_t cycle() const { return cycle_; }
  int64_t timeNs() const { return time_ns_; }
  void release();
  // What refers to another version of the program is not wanted any more; no activation runs.
  void cancel() { release(); }

 private:
  enum class State : uint8_t { Idle, Wanted, Taking, Taken };
  std::atomic<State> state_{State::Idle};
  std::atomic<int64_t> wanted_ns_{0};
  std::vector<SharedList> lists_;
  std::vector<std::vector<uint8_t>> copies_;
  int64_t cycle_ = 0, time_ns_ = 0;
};

}  // namespace rung::host
