// SPDX-License-Identifier: Apache-2.0
// Writes files whole or not at all. Called by all commands that write to disk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rung::driver {

class Sink;

struct TextFile {
  std::string path, text;
};

// Returns an error message, or an empty string. `permissions`: those of the file; 0: as usual for a new one.
[[nodiscard]] std::string writeFile(const std::string& path, const std::string& text, uint32_t permissions = 0);
// Writes files below a folder; returns the exit code.
int writeFiles(const std::string& folder, const std::vector<TextFile>& files, Sink& sink);

}  // namespace rung::driver
