// SPDX-License-Identifier: Apache-2.0
// Paths in the files that list a project: `sources` of rung.project, `Include` of a .plcproj. In: a view and a file.
// Out: where a path is written, and the file or folder, where there is one.
#pragma once

#include <string>
#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

struct DocumentLink {
  FileRange at;
  std::string path;  // absolute
};
// Empty for other files.
std::vector<DocumentLink> linksOf(const View& view, FileId file);

}  // namespace rung::ide
