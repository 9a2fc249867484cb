// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION and its contents. collectConfigurations() declares its globals; resolveConfigurations() creates the
// tasks and program instances, after all declarations are resolved. Called by check().
#pragma once

#include <string>

#include "sema/context.h"
#include "sema/scopes.h"

namespace rung::sema {

void collectConfigurations(Context& context);
void resolveConfigurations(Context& context);

// What follows when all bodies are checked: PLC_PRG that nothing calls gets a task, and tasks get the times of
// rung.project.
void addFreeProgram(Context& context);
void setTaskDurations(Context& context);
// Gives the I/O modules of rung.project their bus cycle tasks.
void setIoModules(Context& context);

// VAR_ACCESS, when all instances are laid out. (access_paths.cpp)
void resolveAccessPaths(Context& context);

// ---- collect.cpp: global lists of files, configurations and resources
ListId listNamed(Context& context, const std::string& name, FileId file, Loc loc, NameMap& qualifiers);
void addGlobals(Context& context, ListId list, DeclId section, NameMap& bare);

}  // namespace rung::sema
