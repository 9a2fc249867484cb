// SPDX-License-Identifier: Apache-2.0
// Types as written become TypeIds: elementary types, names, arrays, strings, subranges, enumerations, structures,
// pointers; see types.cpp.
#pragma once

#include "sema/context.h"

namespace rung::sema {

// Resolves a type as written; after a report kError.
TypeId resolveType(Context& context, TypeExprId type);
// What resolveType() found before; none: nothing yet.
TypeId typeAsWritten(const Context& context, TypeExprId type);
// The record type of a STRUCT or UNION, without its members. (types.cpp)
TypeId addStructure(Context& context, TypeExprId written, NameId name);
// USTRING and UCHAR of edition 4 are not keywords: the project's own type of such a name, or none.
TypeId ownTypeOfLateName(Context& context, NameId name, Loc loc, types::TypeKind kind);
void resolveNamed(Context& context, TypeId type);
void reportTooDeep(Context& context, Loc loc, const char* what, uint32_t limit);
TypeId lookUpType(Context& context, NameId name, Loc loc = {});

}  // namespace rung::sema
