// SPDX-License-Identifier: Apache-2.0
// The assertions of a test as variables: 0 not reached, 1 held whenever it was reached, 2 failed; and its moments as
// cycles, where TEST_ADVANCE moves the time. In: a test. Out: edits of its body, and what the variables stand for.
// Called by neutral.cpp.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tools/conformance/edits.h"
#include "tools/conformance/source.h"

namespace rung::conformance {

constexpr int64_t kCycleNs = 10'000'000;  // of the task of a test

struct Checks {
  std::vector<std::string> names;       // of the variables
  std::vector<std::string> conditions;  // what they check
  std::vector<std::string> variables;   // further ones, as declarations
  std::vector<Edit> edits;              // of statements
  int64_t cycles = 0;                   // that the test takes; 0: as many as it says
  std::string reason;                   // why it cannot be written so
};

// `choices`: conditions about what the standard leaves open; they are left out. `body`: where its statements begin.
Checks checksOf(const Source& source, DeclId test, size_t body, const std::set<std::string>& choices);

// Tells whether something below the node asserts.
bool hasAssertions(const Source& source, DeclId id);

// Tells whether a name of the text begins like this.
bool hasName(std::string_view text, std::string_view beginning);

}  // namespace rung::conformance
