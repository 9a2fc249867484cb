// SPDX-License-Identifier: Apache-2.0
// Whether the sources of a project differ from those when it was asked last (--watch-files): by the times and sizes of
// all files of the project's folders that Rung reads. Called by run.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/driver/options.h"

namespace rung::driver {

class SourceWatch {
 public:
  explicit SourceWatch(const ProjectOptions& project);
  // True once for each change, when the files have been quiet since the last question: editors write in steps.
  bool hasChanged();

 private:
  uint64_t look() const;

  std::vector<std::string> roots_;
  uint64_t known_, seen_;
};

}  // namespace rung::driver
