// SPDX-License-Identifier: Apache-2.0
// Expressions of ST about a stopped program, as watches, conditions and the console have them: variables as the code of
// a frame sees them, literals, operators, and standard functions without effects. In: a text and a frame. Out: a value,
// which nothing of the program changes for. `prev(x)` is what x was before the cycle.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "tools/debug/values.h"

namespace rung::debug {

struct Evaluated {
  std::string error;  // empty: there is a value
  std::string value, type;
  Variable place;  // empty: a value without a place
  bool truth = false;
  bool is_bool = false;
  uint64_t named = 0, indexed = 0;
};

class Expressions {
 public:
  // `before_cycle` runs a function while the program is before the first activation of its cycle; null: there is no
  // past to look at.
  using BeforeCycle = std::function<bool(const std::function<void()>& look)>;
  Expressions(Execution& execution, Values& values, BeforeCycle before_cycle);
  ~Expressions();

  Evaluated evaluate(std::string_view text, const DebugFrame* frame);
  // What is wrong with an expression as such; empty: nothing.
  std::string check(std::string_view text);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rung::debug
