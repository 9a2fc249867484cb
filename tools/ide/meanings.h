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

// What a path denotes.
struct Value {
  Entity entity;  // none: an element of an array, a result
  TypeId type;
};

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
  // A path as written, also one that is not finished.
  Value valueOf(PouId from, ExprId written) const;
  // THIS; SUPER with `is_base`. None: not in an object.
  TypeId typeOfObject(PouId from, bool is_base) const;

 private:
  PouId pouIn(Slice<DeclId> decls, Loc at) const;
  Value stepFrom(PouId from, const Value& base, ExprId step) const;

  const View& view_;
  Scope scope_;
  mutable std::unordered_map<uint32_t, std::vector<NamePlace>> places_;  // by file
  mutable std::unordered_map<uint32_t, Value> values_;                   // of paths, by expression
};

}  // namespace rung::ide
