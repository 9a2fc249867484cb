// SPDX-License-Identifier: Apache-2.0
// The variables that a write to a place can change, of those that a pass knows: the locals and the fields of self. In:
// a body and its private locals (support.h). Out: the effect of one place. Used by the passes about checks.
#pragma once

#include <vector>

#include "ir/exposure.h"
#include "ir/walk.h"

namespace rung::ir {

struct Effect {
  enum Kind : uint8_t {
    None,     // no variable that a pass knows
    Local,    // one private local: `index`
    Field,    // one field of self: `index`
    Exposed,  // fields of self whose address is taken somewhere (exposure.h)
    Fields    // any field of self
  } kind;
  uint32_t index = 0;
};

Effect effectOfWrite(const Module& module, const Body& body, const std::vector<bool>& private_locals, ExprId place);

// Tells whether a statement binds a reference in self: a pointer there has another value.
bool bindsOwn(const Body& body, const Stmt& stmt);

// Tells whether a call may write any field of self: it runs for self, or its code reaches the instance through globals.
// Else it reaches the fields whose address is taken.
bool callReachesSelf(const Module& module, const Exposure& exposure, const Body& body, const CallStmt& call);

// FUNCTION_BLOCK, PROGRAM or an interface: such a variable may be self.
bool isObject(const types::TypeTable& types, TypeId type);

}  // namespace rung::ir
