// One generated source: the bodies of about fifty POUs, and what they use. In: bodies sorted by name (groups.cpp cuts
// them). Out: the group's text once every body was written (emit.cpp puts it together).
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"
#include "codegen/facts.h"

namespace rung::codegen {

// Where a check stands: a row of the module's site table.
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
  std::string code;                // their text
  std::string data;                // constant bytes
  std::vector<Site> sites;
  std::vector<TypeId> records;       // whose headers it includes
  std::vector<ir::BodyId> callees;   // functions and natives to be declared
  std::vector<ir::BodyId> virtuals;  // methods whose dispatch it uses
  std::vector<TypeId> classes;       // whose numbers it uses
  std::vector<NameId> libraries;     // whose headers with sized forms it includes
  std::vector<ir::BodyId> inlined;   // small pure library functions that they call, each in a header of its own
  uint32_t data_count = 0;
};

// Marks that are equal for what the group at hand has listed already.
struct Marks {
  std::vector<uint32_t> body, record, data, data_number;
  std::vector<uint32_t> hot;  // small bodies that the group calls in loops
};

// Cuts the bodies that have code into groups; the cuts depend on the names alone.
std::vector<Group> makeGroups(const ir::Module& module, const Facts& facts);

// Marks the small bodies that bodies of the group call in loops. They become inline functions that are emitted all the
// same: other groups call them, and this group's text depends on its own bodies alone.
void markHot(const ir::Module& module, const Group& group, Marks& marks, uint32_t group_number);

}  // namespace rung::codegen
