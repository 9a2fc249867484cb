// SPDX-License-Identifier: Apache-2.0
// What the names in the sources mean. In: a view. Out: for each name of a parsed text its entity, as the check resolved
// it; where it did not, because the line is not finished, as Scope finds it. Asked by hover, definition, semantic
// tokens and completion.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "tools/ide/scope.h"
#include "tools/ide/view.h"

namespace rung::ide {

// A name in a parsed text.
struct NamePlace {
  Loc loc;
  Entity entity;
  bool is_declaration = false;
};

class Meanings {
 public:
  // The view has a project.
  explicit Meanings(const View& view);

  const Scope& scope() const { return scope_; }

  // Sorted by location. Made when they are first asked for.
  const std::vector<NamePlace>& of(const FileUnit& unit) const;
  // The name that has this byte, or ends before it.
  std::optional<NamePlace> at(Loc parsed) const;

  // The POU whose declaration or body has this byte; none: file level.
  PouId pouAt(Loc parsed) const;
  // Of an expression as written, also one that is not finished; none: unknown.
  TypeId typeOf(PouId from, ExprId written) const;
  Entity entityOf(PouId from, ExprId written) const;

 private:
  TypeId typeOfObject(PouId from, bool is_base) const;

  const View& view_;
  Scope scope_;
  mutable std::unordered_map<uint32_t, std::vector<NamePlace>> places_;  // by file
};

}  // namespace rung::ide
