// SPDX-License-Identifier: Apache-2.0
// The trace of a run: CSV rows after each cycle, or the last row as `path = value` lines. In: the watched variables.
// Out: a file that appears whole or not at all, or standard output.
#pragma once

#include <string>
#include <vector>

#include "forces.h"
#include "output_file.h"
#include "symbols.h"

namespace rung::host {

class Trace {
 public:
  explicit Trace(const Symbols& symbols) : symbols_(&symbols) {}

  enum class Use : uint8_t { Rows, LastRow };
  // `watch`: the list of --watch, or empty for all variables of all programs. Of what is only listed at the end, the
  // first kMostListed. False: `error` has the message.
  bool choose(const std::string& watch, Use use, std::string& error);
  // The variables of one program: of library blocks only the pins.
  bool chooseProgram(const std::string& name, std::string& error);
  // Another version of the program goes on. Returns the paths of variables that it does not have: their cells are
  // empty.
  std::vector<std::string> moveTo(const Symbols& symbols) {
    symbols_ = &symbols;
    return symbols.findAgain(variables_);
  }
  // The last column names the variables of the others that are forced. `forces` outlives the trace.
  void markForced(const Forces& forces) { forces_ = &forces; }
  // `path`: --trace, "-" for standard output, empty for none.
  bool open(const std::string& path, std::FILE* out, std::string& error);
  void row(int64_t cycle, int64_t time_ns);
  // Writes the rest and renames the file to its final path.
  bool close(std::string& error);
  // The current values as `path = value` lines, and the count of those that are not listed.
  std::string lastRow() const;
  const std::vector<Variable>& variables() const { return variables_; }

 private:
  void appendForced();
  bool add(const Variable& variable, Symbols::Detail detail, Use use, std::string& error);

  const Symbols* symbols_;
  uint64_t total_ = 0;  // with those that are not listed
  std::vector<Variable> variables_;
  const Forces* forces_ = nullptr;  // null: no column of forces
  OutputFile file_;
  std::string buffer_, cell_;
};

// Milliseconds without trailing zeros: `20`, `0.5`.
std::string millisecondsOf(int64_t ns);

}  // namespace rung::host
