// Writes files whole or not at all. Called by all commands that write to disk.
#pragma once

#include <string>
#include <vector>

namespace rung::driver {

class Sink;

struct TextFile {
  std::string path, text;
};

// Returns an error message, or an empty string.
[[nodiscard]] std::string writeFile(const std::string& path, const std::string& text);
// Writes files below a folder; returns the exit code.
int writeFiles(const std::string& folder, const std::vector<TextFile>& files, Sink& sink);

}  // namespace rung::driver
