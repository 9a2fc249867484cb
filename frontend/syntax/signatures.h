// SPDX-License-Identifier: Apache-2.0
// The only questions that the scheduler of a body may ask about a name: whether it can be called, and with which pins.
// Types are not available to it. The checker of programs implements this interface and passes it to the
// scheduler when it is about to check the body. Answers are valid as long as the object.
#pragma once

#include <span>
#include <string>

#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/ids.h"

namespace rung {

enum class SignatureKind : uint8_t {
  Unknown,   // not declared; includes names built by a rule, such as INT_TO_REAL
  Value,     // a variable or constant that cannot be called
  Instance,  // of a function block
  Function,
  Method,  // or an action
  Block,   // a function block type; its pins are those of its instances
  Program,
  Other,  // a type, a list of globals, a library
};
struct PinSignature {
  NameId name;
  std::span<const NameId> aliases;
  PinDirection direction;
  bool is_bool, required, lazy, extensible;
  ExprId initial;  // the declared default; none: that of its type
};
struct Signature {
  SignatureKind kind = SignatureKind::Unknown;
  bool has_result = false;  // of functions and methods
  std::span<const PinSignature> pins;
  TypeExprId result{};  // as declared; none: of generic functions too

  // By name or alias, except EN and ENO; null: not found.
  const PinSignature* find(const Names& names, NameId pin) const {
    for (const PinSignature& candidate : pins) {
      if (names.same(candidate.name, pin)) return &candidate;
      for (const NameId alias : candidate.aliases)
        if (names.same(alias, pin)) return &candidate;
    }
    return nullptr;
  }
};

struct PouDecl;  // nodes.h

class Signatures {
 public:
  virtual Signature of(NameId name) = 0;  // points separate the names of members
  // Of `valve`, `valves[i].timer`, `station.Start`: a path as parsed, which is not changed.
  virtual Signature of(ExprId path) = 0;
  // False: `instance` is of a function block, and not of `block` or one derived from it.
  virtual bool fits(ExprId instance, ExprId block) = 0;
  // The sections that schedulers made for a POU, beside those that it declares.
  virtual std::span<const DeclId> madeSections(const PouDecl& pou) = 0;
  // The name of the type of a variable that is certainly not BOOL; else empty.
  virtual std::string typeUnlessBool(ExprId path) = 0;

 protected:
  ~Signatures() = default;
};

}  // namespace rung
