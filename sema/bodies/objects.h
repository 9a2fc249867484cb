// SPDX-License-Identifier: Apache-2.0
// Objects in bodies: THIS and SUPER, calls of methods and actions, properties; see objects.cpp.
#pragma once

#include <optional>

#include "sema/access.h"
#include "sema/context.h"

namespace rung::sema {

// Checks the arguments for FB_Init in the declaration of a variable; `type` is as written. (bodies/objects.cpp)
// For an array whose elements have separate arguments, `elements` calls follow each other.
CallId checkConstructor(Context& context, TypeExprId type, uint32_t& elements);
// A variable named THIS or SUPER hides the keyword.
TypeId checkThisOrSuper(Context& context, ExprId& expr, TypeId expected, Access access);

// `base.member` where base is an object: a method or action (then without a type) or a property that is read. None when
// the object has no such member, except perhaps a variable. `method`: the member, where it is known.
std::optional<TypeId> checkObjectMember(Context& context, ExprId& expr, PouId object, Access access, PouId method = {});

// The same for a bare name of a member of the current object.
TypeId useMember(Context& context, ExprId& expr, Entity member, ExprId instance, Access access);
TypeId callMethod(Context& context, ExprId& expr, PouId method, ExprId instance, bool as_statement);
// `object.property := value`: true when the target is a property; it becomes the call of its SET.
bool checkPropertyAssign(Context& context, AssignStmt& node);
// A pointer to an interface, THIS and SUPER are used like their target: makes the `^` explicit.
TypeId throughObject(Context& context, ExprId& expr, TypeId type);
// Whether the object in an lvalue has exactly the declared type.
bool isExact(const Context& context, ExprId instance);

}  // namespace rung::sema
