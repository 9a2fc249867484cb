// SPDX-License-Identifier: Apache-2.0
// The diagnostics of a project for an editor. In: a snapshot. Out: those of each file, with what an editor shows beside
// the message: related places, the page of the code, and whether what is marked is unnecessary or obsolete.
#pragma once

#include <string>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "tools/ide/view.h"

namespace rung::ide {

struct RelatedPlace {
  FileRange at;
  std::string message;
};
struct FileDiagnostic {
  std::string path;  // absolute
  FileRange at;      // none: the file as a whole
  Severity severity;
  const char* code;
  std::string message;  // with the notes that have no place of their own, one a line
  std::vector<RelatedPlace> related;
  const Diagnostic* of;  // of the view
  bool is_unnecessary = false, is_deprecated = false;
};

// In the order in which `rung check` prints them, but for those about a folder.
std::vector<FileDiagnostic> diagnosticsOf(const View& view);

}  // namespace rung::ide
