// SPDX-License-Identifier: Apache-2.0
// Where the values of expressions are in the running program. In: a checked project. Out: for each expression that
// denotes a variable its path: `.pump.on` in an instance of the POU that has it, `level` or `%IX0.3` anywhere.
// Variables of a call have none. Called by pou_views.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/source/files.h"
#include "sema/project.h"

namespace rung::driver {

class ValuePaths {
 public:
  explicit ValuePaths(const sema::Project& project);

  // Of an expression as written; empty: none.
  std::string of(ExprId written) const;
  // The elementary variables that declarations and code name, by location: of `a.b.c` the whole path.
  struct Mention {
    Loc loc;
    std::string path;
  };
  std::vector<Mention> in(Range range) const;

 private:
  struct Found {
    std::string path;
    bool is_elementary = false;
  };
  template <class Id>
  void visit(Id id);
  bool addExpression(ExprId id);
  void addDeclaration(sema::VarId id);
  bool pathOf(ExprId id, std::string& path) const;
  bool namedPath(ExprId id, std::string& path) const;
  bool rootPath(const sema::Var& var, std::string& path) const;
  bool indicesOf(const IndexExpr& node, std::string& path) const;
  bool isElementary(TypeId type) const;
  static uint64_t keyOf(Loc loc, ExprKind kind) { return uint64_t{loc.offset} << 8 | static_cast<uint8_t>(kind); }

  const sema::Project& project_;
  const Tree& tree_;
  std::unordered_map<uint32_t, uint32_t> globals_;  // how many have a name, by its key
  std::unordered_map<uint64_t, Found> by_place_;
  std::vector<Mention> mentions_;  // sorted
};

}  // namespace rung::driver
