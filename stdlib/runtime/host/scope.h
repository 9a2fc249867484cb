// SPDX-License-Identifier: Apache-2.0
// The trace on the controller of a run: a rung_scope with its memory, sampled at the end of the activations of one
// task. In: which variables, and when. Out: rows, which are read while it runs or later. Sampled under the lock of the
// image, by tasks.cpp; all else is called by whoever serves the user, from any one thread.
#pragma once

#include <string>
#include <vector>

#include "exchange.h"
#include "rung/scope.h"

namespace rung::host {

struct ScopeOrder {
  std::vector<std::string> paths;
  uint32_t task = 0;
  uint32_t divider = 1;  // every so many activations
  uint32_t rows = 10'000;
  rung_scope_condition condition = RUNG_SCOPE_NONE;
  std::string trigger, level;  // a path and a value; of a BOOL without a value: TRUE
  uint32_t rows_before = 0;
};

struct ScopeState {
  rung_scope_state state = RUNG_SCOPE_OFF;
  uint32_t first = 0, next = 0;      // the numbers of the oldest row, and of the one that follows the newest
  uint32_t trigger_row = RUNG_NONE;  // none: not triggered
};

// Rows that were read. `bytes` has them one after the other.
struct ScopeRows {
  uint32_t first = 0, count = 0;
  std::vector<uint8_t> bytes;
};

class Scope {
 public:
  static constexpr uint32_t kMostChannels = 64, kMostRows = 1'000'000, kMostBytes = 32u << 20;

  Scope(const Symbols& symbols, Exchange& image) : symbols_(symbols), image_(image) {}
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

  // Begins, and forgets what was before. Empty, or what is wrong: then nothing has changed.
  std::string start(const ScopeOrder& order);
  void stop();
  ScopeState state() const;
  // Rows from this number on, or from the oldest; as many as may be copied while a task waits.
  ScopeRows read(uint32_t from, uint32_t count) const;

  const std::vector<Variable>& variables() const { return variables_; }
  uint32_t task() const { return task_; }
  static int64_t timeOf(const uint8_t* row) { return rung_scope_time(row); }
  const uint8_t* row(const ScopeRows& rows, uint32_t number) const {
    return rows.bytes.data() + size_t{number} * scope_.row_size;
  }
  // The value as a trace prints it.
  std::string value(const uint8_t* row, uint32_t channel) const;

  // An activation of the task has ended; under the lock of the image.
  void sample(uint32_t task, const rung_context& context, int64_t now_ns) {
    if (task == task_) rung_scope_sample(&scope_, &context, now_ns);
  }

 private:
  std::string findChannels(const ScopeOrder& order, std::vector<Variable>& variables) const;
  std::string findTrigger(const ScopeOrder& order, rung_scope& scope) const;

  const Symbols& symbols_;
  Exchange& image_;
  std::vector<Variable> variables_;
  std::vector<rung_variable> channels_;
  std::vector<uint8_t> ring_;
  rung_scope scope_{};
  uint32_t task_ = RUNG_NONE;
};

}  // namespace rung::host
