// SPDX-License-Identifier: Apache-2.0
// What can be written where a value of a type is wanted, so that a call or an assignment is whole before its places are
// filled in. In: a type, or a pin. Out: a literal, or a variable that is visible. Used by completion.
#pragma once

#include <string>
#include <unordered_map>

#include "tools/ide/scope.h"
#include "tools/ide/view.h"

namespace rung::ide {

class DefaultValues {
 public:
  // Of the variables that `from` sees.
  DefaultValues(const View& view, PouId from);

  // Of a pin of a call: a variable with the name of the pin, else a literal, else any variable. Empty: there is none.
  std::string argumentFor(VarId pin);
  std::string literalOf(TypeId type) const;
  // `REAL#0.0`; empty where there is none.
  std::string typedLiteralOf(TypeId type) const;
  // One that can be written to; empty: there is none.
  std::string variableOf(TypeId type);

 private:
  void collect();
  std::string text(NameId name) const { return std::string(view_.names().string(name)); }

  const View& view_;
  const Scope& scope_;
  const sema::Project& project_;
  PouId from_;
  bool is_collected_ = false;
  std::unordered_map<uint32_t, VarId> by_name_, by_type_;
};

}  // namespace rung::ide
