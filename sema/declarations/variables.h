// SPDX-License-Identifier: Apache-2.0
// Variables of POUs and global lists: their names first, then types and storage, then initial values; each on
// demand; see variables.cpp.
#pragma once

#include <vector>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

// Makes sure that a POU's result, pins and variables are resolved (not its body). Safe against cycles.
void resolvePou(Context& context, PouId pou);

// VAR_GLOBAL in a PROGRAM: allowed by the standard, not by codesys.
inline bool mayHoldGlobals(const Context& context, PouKind kind) {
  return kind == PouKind::Program && context.profile().globals_in_programs;
}

// Gives the variables of one VarDecl their ids and names. Types follow later.
void declareVars(Context& context, DeclId decl, const SectionDecl& section, PouId pou, ListId list, NameMap* names,
                 std::vector<VarId>& into);
void ensureVarType(Context& context, VarId id);
// The declared initial value of the variables of one VarDecl: checked once; constants get their values.
void ensureInitialValue(Context& context, VarId id);
void declarePou(Context& context, PouId pou);
void resolveList(Context& context, ListId list);
void checkModifiers(Context& context, const SectionDecl& section);
// The field of a record that holds a variable.
void addField(Context& context, TypeId record, VarId id);

}  // namespace rung::sema
