// SPDX-License-Identifier: Apache-2.0
// CONFIGURATION and its contents. collectConfigurations() declares its globals; resolveConfigurations() creates the
// tasks and program instances, after all declarations are resolved. Called by check().
#pragma once

#include "sema/context.h"

namespace rung::sema {

void collectConfigurations(Context& context);
void resolveConfigurations(Context& context);
// What follows when all bodies are checked: PLC_PRG that nothing calls gets a task, and tasks get the times of
// rung.project.
void addFreeProgram(Context& context);
void setTaskDurations(Context& context);
// Gives the I/O modules of rung.project their bus cycle tasks.
void setIoModules(Context& context);

}  // namespace rung::sema
