// SPDX-License-Identifier: Apache-2.0
// Objects: the methods, actions and properties of a block, class or interface, what it extends and implements, and
// the hidden fields with which its instances begin. An object that may be used through a pointer, an in-out or an
// interface begins with a 32-bit type id, by which its methods and its body are found (`dispatched`): an object with
// methods, interfaces or ABSTRACT, and one that the project extends; see objects.cpp.
#pragma once

#include <span>

#include "sema/context.h"

namespace rung::sema {

// The object whose members a body may name: its block, or the owner of the method. None in functions.
PouId objectOf(const Context& context);
// A variable, method, action or property of an object or of its bases; none when there is none.
Entity findInObject(Context& context, PouId object, NameId name);
// Whether `object` is `base`, extends it or implements it.
bool isKindOf(Context& context, PouId object, PouId base);
// The interface or block whose record, or pointer to an interface, a type is; none for other types.
PouId interfaceOf(Context& context, TypeId type);
// FB_Init of an object, its own or inherited; none when it has none.
PouId constructorOf(const Context& context, PouId object);

// Kinds with locals and parameters instead of an instance.
inline bool isFunction(PouKind kind) {
  return kind == PouKind::Function || kind == PouKind::Method || kind == PouKind::Action;
}

// METHODs, ACTIONs and PROPERTYs of a POU: a Pou each.
void collectMembers(Context& context, PouId owner);
// FB_Init, FB_Reinit, FB_Exit: called when an instance is created, moved and destroyed (codesys).
bool isLifeMethod(const Context& context, NameId name);
// Resolves what an object extends and implements; checked once.
void resolveHeader(Context& context, PouId object);
// The same for all POUs, so that it is known which blocks are extended before the first is laid out.
void resolveHeaders(Context& context);
// The hidden fields with which an object begins: type id, base.
void addObjectFields(Context& context, PouId object);
// The names of members in the scope of their object, and VAR_INST of its methods.
void declareMembers(Context& context, PouId object);
// The FB or program whose instance a record type is; none for structures.
PouId pouOf(Context& context, TypeId record);
// The inputs, in-outs and outputs of a POU, those of its base first.
std::span<const VarId> pinsOf(Context& context, PouId pou);
// Whether `context` may use a member with this access; reports one that it may not.
bool mayAccess(Context& context, AccessLevel access, PouId owner, NameId name, Loc loc);
// Forbids an abstract type for a variable or its parts. False after a report.
bool checkNotAbstract(Context& context, TypeId type, Loc loc);

}  // namespace rung::sema
