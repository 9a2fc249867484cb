// SPDX-License-Identifier: Apache-2.0
// A program of the suite as plain source in the standard's text: without pragmas and assertions. In: the program as its
// author wrote it. Out: a draft for each of its tests, or why there is none.
//
// Each assertion becomes a variable `check_1`, `check_2` … of the test: 0 not reached, 1 held whenever it was reached,
// 2 failed. Variables of the project move into the VAR_GLOBAL of a configuration, and each POU that uses one declares
// it as VAR_EXTERNAL. POUs that the test does not reach are left out. Lines stay where they were.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/conformance/program.h"

namespace rung::conformance {

struct Draft {
  std::string test;  // the name of the test; empty: the whole program
  std::string text;
  std::vector<std::string> watch;      // paths of its checks
  std::vector<std::string> checks;     // the assertions that they stand for
  std::string done;                    // the path of the variable that ends it; empty: see `cycles`
  int64_t cycles = 0;                  // that it takes; 0: one
  std::vector<std::string> languages;  // ST, IL, SFC, LD, FBD, CFC
  bool has_objects = false;            // classes, interfaces, methods, inheritance
  bool has_networks = false;           // in Rung's notation: to be printed as XML
  std::string reason;                  // why it cannot be exported
};

// The tests of a program, one draft each; without tests one draft of the whole.
std::vector<Draft> neutralDrafts(const Program& program);

}  // namespace rung::conformance
