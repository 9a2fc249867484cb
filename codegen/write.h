// SPDX-License-Identifier: Apache-2.0
// Writes a set of generated files to a folder: all or nothing. Files with equal content stay untouched; files that the
// manifest (`rung.manifest`) lists and this run no longer makes are deleted.
#pragma once

#include <string>
#include <vector>

#include "codegen/emit.h"

namespace rung::codegen {

struct WriteResult {
  std::string error;  // empty: written
  std::vector<std::string> written, kept, deleted;
};
[[nodiscard]] WriteResult writeOutputs(const std::string& folder, const std::vector<OutputFile>& files);

// A depfile (make syntax): `target` depends on each source; blanks and `#` escaped.
std::string depfile(const std::string& target, const std::vector<std::string>& sources);

}  // namespace rung::codegen
