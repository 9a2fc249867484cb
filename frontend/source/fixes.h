// SPDX-License-Identifier: Apache-2.0
// The fixes of diagnostics as edits of files on disk. In: a fix, whose locations are in what was parsed. Out: bytes of
// files, and the text to write there as the file writes it: escaped in XML, with the line ends of the file. A place
// that Rung made cannot be edited, as a wire of a drawing. Called by all that show or apply fixes.
#pragma once

#include <string>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"

namespace rung {

struct FileEdit {
  FileId file;
  uint32_t begin = 0, end = 0;  // bytes
  std::string text;
};

// Sorted, and apart from each other. Empty: a place of the fix is not in a file.
std::vector<FileEdit> fileEdits(const Sources& sources, const Diagnostic& diagnostic, const Fix& fix);

}  // namespace rung
