// SPDX-License-Identifier: Apache-2.0
// Name lookup: the meaning of a name at a location, members of records, the name nearest to a misspelled one; see
// names.cpp.
#pragma once

#include <string_view>

#include "sema/context.h"

namespace rung::sema {

// The meaning of a name at `context`: variables of the POU, then the namespaces around it, then POUs, types, globals,
// enumeration items and lists of the project, then libraries, which are read on first use. None when unknown. Reports
// only if `loc` is given, and only a name that USINGs make ambiguous or that is INTERNAL elsewhere.
Entity lookUp(Context& context, NameId name, Loc loc = {});

// The meaning of a written name: `.name` is looked up outside of POUs.
Entity lookUp(Context& context, const NameExpr& name, Loc loc = {});

// `qualifier.name`: members of a GVL, of a namespace, of an enumeration type.
Entity lookUpIn(Context& context, Entity qualifier, NameId name);
// True when several enumerations have an item of this bare name: its context must decide which is meant.
bool isAmbiguousItem(Context& context, Entity item);
// The visible name most similar to a misspelled one, or empty.
std::string_view nearestName(Context& context, NameId written);
// The same among what a call can name: functions, programs, methods and variables.
std::string_view nearestCallable(Context& context, NameId written);
// Syntax errors took declarations from this POU, or its base is not known: a missing name is not a second mistake.
bool isBroken(const Context& context, PouId pou);
// Whether to report that a name, or a member of a record, is not declared: once per POU, and only where no declaration
// was lost to a syntax error.
bool isFirstReport(Context& context, NameId name);
bool isFirstReportOfMember(Context& context, TypeId record, NameId name);
// A field or pin of a record, by name or by a pin's alias; none when there is none.
VarId findMember(Context& context, TypeId record, NameId name);
// A variable or pin of a POU by name or alias; none when there is none.
VarId findPin(Context& context, PouId pou, NameId name);
// A global variable as the resource of `context` sees its name.
Entity globalOfResource(const Context& context, NameId key, Entity global);
// Whether code that several resources run cannot name it, because they declare it differently.
bool differsByResource(Context& context, NameId key);
// What was found under a name, or the mock that replaces it in this program: everywhere except in the mock itself.
Entity orMock(Context& context, NameId key, Entity found);
// The meaning of a name with or without namespaces, perhaps not resolved yet.
Entity findDotted(Context& context, NameId dotted);

}  // namespace rung::sema
