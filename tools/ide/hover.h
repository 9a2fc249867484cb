// SPDX-License-Identifier: Apache-2.0
// What an editor shows of the name under the mouse. In: a view and a byte of a file. Out: Markdown: the declaration,
// its documentation, and what is known beside it: the value of a constant, size, address, the task that runs a program.
#pragma once

#include <optional>
#include <string>

#include "tools/ide/library_index.h"
#include "tools/ide/meanings.h"
#include "tools/ide/view.h"

namespace rung::ide {

struct Hover {
  FileRange range;
  std::string markdown;
};
std::optional<Hover> hoverAt(const View& view, const LibraryIndex& libraries, FileId file, uint32_t byte);

// The declaration on its own lines, and the documentation.
struct Description {
  std::string declaration, documentation;
  std::string facts;  // as Markdown, a paragraph each
};
Description describe(const View& view, Entity entity);

}  // namespace rung::ide
