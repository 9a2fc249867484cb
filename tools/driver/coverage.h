// SPDX-License-Identifier: Apache-2.0
// Line and branch coverage of `rung test`. In: interpreted programs that have run, and the display paths of their
// files. Out: a table for people, or a file for lcov and genhtml (geninfo(1)). Called by test.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "ir/interpreter/program.h"

namespace rung::driver {

class Coverage {
 public:
  // Programs of several tests may share files: their counts add up.
  void add(const ir::interpreter::Program& program);
  void nameFile(const std::string& below, const std::string& shown) { shown_[below] = shown; }

  std::string text() const;
  std::string lcov() const;

 private:
  struct File {
    std::map<uint32_t, uint64_t> lines;                              // executable ones
    std::map<std::pair<uint32_t, std::string>, uint64_t> functions;  // by line and name
    // Of each IF and CASE, by line and column: how often each branch was taken, the absent ELSE included.
    std::map<std::pair<uint32_t, uint32_t>, std::map<uint32_t, uint64_t>> branches;
  };
  const std::string& shown(const std::string& below) const;
  static void appendBranches(std::string& out, const File& file);

  std::map<std::string, File> files_;
  std::map<std::string, std::string> shown_;  // by the path below the root
};

}  // namespace rung::driver
