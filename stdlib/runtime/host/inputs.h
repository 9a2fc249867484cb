// SPDX-License-Identifier: Apache-2.0
// Values set from outside: the table of --inputs and the values of --set. In: paths and literals. Out: variables set
// before their cycle. Everything is checked before the run begins.
#pragma once

#include <string>
#include <vector>

#include "symbols.h"

namespace rung::host {

class Inputs {
 public:
  explicit Inputs(const Symbols& symbols) : symbols_(&symbols) {}
  // False: `error` is a complete message, with file and line.
  bool load(const std::string& path, std::string& error);
  // Sets the variables of all rows of this cycle; called with ascending cycles.
  void apply(int64_t cycle);
  // Another version of the program goes on. Returns the paths of variables that it does not have: they are not set.
  std::vector<std::string> moveTo(const Symbols& symbols) {
    symbols_ = &symbols;
    return symbols.findAgain(variables_);
  }
  // The next call of apply() is for this cycle, perhaps again.
  void goTo(int64_t cycle);
  // The last cycle that a row names, or -1.
  int64_t lastCycle() const { return last_cycle_; }

 private:
  struct Setting {
    int64_t cycle;
    uint32_t variable;
    std::string value;
  };
  const Symbols* symbols_;
  std::vector<Variable> variables_;
  std::vector<Setting> settings_;
  size_t next_ = 0;
  int64_t last_cycle_ = -1;
};

// Applies PATH=VALUE of --set. Returns an error message, or an empty string.
std::string applySet(const Symbols& symbols, const std::string& path, const std::string& value);

// Reads a whole file ("-": standard input); false when the system fails, with the reason in `error`.
bool readFile(const std::string& path, std::string& content, std::string& error);

}  // namespace rung::host
