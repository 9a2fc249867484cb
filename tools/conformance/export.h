// SPDX-License-Identifier: Apache-2.0
// Turns the programs of the project into cases of a suite: each is written, tried with Rung in its plain form, and kept
// when it passes. In: a project and the profiles. Out: files below a folder, and a Suite that describes them.
#pragma once

#include <string>
#include <vector>

#include "tools/conformance/suite.h"

namespace rung::conformance {

struct ExportOptions {
  std::string root = ".";  // of the project
  std::string folder;      // where the files go
  std::vector<const Profile*> profiles;
  std::vector<std::string> programs;  // only these, relative to the root; empty: all
};

// The error names what could not be read or written.
[[nodiscard]] std::string exportSuite(const ExportOptions& options, Suite& suite);

}  // namespace rung::conformance
