// SPDX-License-Identifier: Apache-2.0
// One generated source: the bodies of about fifty POUs, and what they use. In: bodies sorted by name (groups.cpp cuts
// them into groups). Out: the code of the group once every body is written (emit.cpp assembles it).
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "codegen/facts.h"

namespace rung::codegen {

// The location of a check or a call: a row of the module's site table.
struct Site {
  NameId pou;
  NameId origin_path;  // of IR text; else `file`
  FileId file;
  uint32_t line = 0, column = 0;
  int64_t low = 0, high = 0;
};

struct Group {
  std::string stem;                // of its file, and part of the names that it defines besides functions
  std::vector<ir::BodyId> bodies;  // those it defines
  std::string code;                // the code of these bodies
  std::string data;                // constant bytes
  std::vector<Site> sites;
  std::vector<TypeId> records;       // whose headers it includes
  std::vector<ir::BodyId> callees;   // functions and natives to be declared
  std::vector<ir::BodyId> virtuals;  // methods whose dispatch it uses
  std::vector<TypeId> classes;       // whose numbers it uses
  std::vector<NameId> libraries;     // whose headers with sized forms it includes
  std::vector<ir::BodyId> inlined;   // small functions and blocks that they call, each in its own header
  uint32_t data_count = 0;
};

// Stamps: an entry equals the number of the current group when that has listed the item already.
struct Marks {
  std::vector<uint32_t> body, record, data, data_number;
  std::vector<uint32_t> hot;  // small bodies that the group calls in loops
};

// Cuts the bodies that have code into groups; the cuts depend on the names alone.
std::vector<Group> makeGroups(const ir::Module& module, const Facts& facts);

// Stamps the small bodies that bodies of the group call in loops. They become inline functions that are emitted all
// the same: other groups need only the prototype, so this group's code depends on its own bodies alone.
// Without it (tests/bench/run.sh kernels, --checks=none) `cascade` takes 1.9 times as long, `calendar` 1.1 times.
void markHot(const ir::Module& module, const Group& group, Marks& marks, uint32_t group_number);

}  // namespace rung::codegen
