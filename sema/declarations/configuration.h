// CONFIGURATION and its contents. collectConfigurations() declares its globals; resolveConfigurations() creates the
// tasks and program instances, after all declarations are resolved. Called by check().
#pragma once

#include <string>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

void collectConfigurations(Context& context);
void resolveConfigurations(Context& context);

// VAR_ACCESS, when all instances are laid out. (access_paths.cpp)
void resolveAccessPaths(Context& context);

// ---- collect.cpp: global lists of files, configurations and resources
ListId listNamed(Context& context, const std::string& name, FileId file, Loc loc, NameMap& qualifiers);
void addGlobals(Context& context, ListId list, DeclId section, NameMap& bare);

}  // namespace rung::sema
