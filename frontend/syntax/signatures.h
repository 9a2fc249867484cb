// What the scheduler of a body may ask about a name, and nothing else (design §3): whether it can be called, and with
// which pins. It learns no types. Sema implements it (sema/bodies/signatures.cpp) and hands it to the scheduler when
// the body is about to be checked; answers live as long as the object.
#pragma once

#include <span>

#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/ids.h"

namespace rung {

enum class SignatureKind : uint8_t {
  Unknown,   // not declared; names that follow a rule, such as INT_TO_REAL, are among them
  Value,     // a variable or constant that cannot be called
  Instance,  // of a function block
  Function,
  Method,  // or an action
  Block,   // a type of function blocks; its pins are those of its instances
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

  // By name or alias, EN and ENO apart; null: there is none.
  const PinSignature* find(const Names& names, NameId pin) const {
    for (const PinSignature& candidate : pins) {
      if (names.same(candidate.name, pin)) return &candidate;
      for (const NameId alias : candidate.aliases)
        if (names.same(alias, pin)) return &candidate;
    }
    return nullptr;
  }
};

class Signatures {
 public:
  virtual Signature of(NameId name) = 0;
  // Of `valve`, `valves[i].timer`, `station.Start`: a path as parsed. It stays as it is.
  virtual Signature of(ExprId path) = 0;

 protected:
  ~Signatures() = default;
};

}  // namespace rung
