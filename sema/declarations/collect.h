// SPDX-License-Identifier: Apache-2.0
// Collects declarations: every POU, type, enumeration item and global of the files gets its entity and its name, so
// that the order of files and declarations does not matter; see collect.cpp.
#pragma once

#include <string>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

void internKnownNames(Context& context);
// The declarations of all files of the tree.
void collectFiles(Context& context);
// One declaration at `context`; of a library when `library` is given.
void collectDecl(Context& context, DeclId decl, FileId file, uint32_t library);
NamedType& addNamed(Context& context, TypeId type);
// The pragma with this name key, or null.
const Pragma* findPragma(const Context& context, const DeclHeader& header, NameId key);
void reportTwice(Context& context, NameId name, Loc loc, Loc first);
// Adds the items of an enumeration to a table; their values are resolved later.
void declareItems(Context& context, TypeId type, TypeExprId written, NameMap* bare, bool project_wide);
ListId listNamed(Context& context, const std::string& name, FileId file, Loc loc, NameMap& qualifiers);
void addGlobals(Context& context, ListId list, DeclId section, NameMap& bare);

}  // namespace rung::sema
