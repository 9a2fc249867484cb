// SPDX-License-Identifier: Apache-2.0
// Lines above declarations: how often a POU or type is used, which tests can be run, which task runs a program. In: a
// view and a file. Out: the lines; references are counted later, for those that an editor shows.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/view.h"
#include "tools/workspace/workspace.h"

namespace rung::ide {

enum class LensKind : uint8_t { References, Test, Task };
struct CodeLens {
  FileRange at;  // the name of the declaration
  LensKind kind;
  std::string text;  // of a test its name, of a task what an editor shows
};
std::vector<CodeLens> lensesOf(const View& view, FileId file);

// `the task `fast`, every T#20ms`; empty: none runs it.
std::string taskText(const View& view, const sema::ProgramInstance& instance);

}  // namespace rung::ide
