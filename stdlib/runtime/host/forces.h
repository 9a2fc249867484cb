// SPDX-License-Identifier: Apache-2.0
// The forced variables of a run: the table of rung/monitor.h with the names that the user gave. In: variables and
// values. Out: memory in which they hold. It changes where no activation runs; tasks apply it (tasks.cpp).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "symbols.h"

namespace rung::host {

class Forces {
 public:
  explicit Forces(const Symbols& symbols) : symbols_(symbols) {}
  Forces(const Forces&) = delete;
  Forces& operator=(const Forces&) = delete;

  bool isEmpty() const { return table_.count == 0; }
  // Empty, or why this value cannot be forced.
  std::string check(const Variable& variable, std::string_view value) const;
  // Tells whether so many more variables can be forced.
  bool hasRoom(size_t more) const;
  // With a value that check accepts.
  void force(const Variable& variable, std::string_view value);
  void unforce(const Variable& variable);
  void unforceAll();
  // Forces what the version before of the program has forced. Returns the paths of variables that this one does not
  // have, or that do not take the value.
  std::vector<std::string> takeFrom(const Forces& before);
  // Paths and values, in the order in which the variables were forced; the same as `path = value` lines.
  std::vector<std::pair<std::string, std::string>> values() const;
  std::string list() const;
  const std::vector<Variable>& names() const { return names_; }
  // Tells whether a forced variable has a bit in common with this one.
  bool touches(const Variable& variable) const;

  // Writes the forced values to the memory of a context.
  void apply(const rung_context& context) const {
    if (!isEmpty()) rung_apply_forces(&context, &table_);
  }
  // Those that `wants` are not applied until the next call.
  template <class F>
  void hold(F wants) {
    for (uint32_t i = 0; i < table_.count; ++i) table_.rows[i].is_held = wants(table_.rows[i].variable) ? 1 : 0;
  }

  void transfer(StateArchive& archive);

 private:
  std::string valueOf(const Variable& name) const;

  const Symbols& symbols_;
  std::vector<rung_forced> rows_;
  std::vector<uint8_t> values_;
  rung_forces table_{};
  std::vector<Variable> names_;  // of each row one, in any order
};

}  // namespace rung::host
