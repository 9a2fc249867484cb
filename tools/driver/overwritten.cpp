// SPDX-License-Identifier: Apache-2.0
// See overwritten.h. A source is a file that the command line names, and in a folder that it names any file that holds
// a program or the messages of one; results of an earlier run are replaced, in a folder of sources too.
#include "tools/driver/overwritten.h"

#include <filesystem>
#include <fstream>

#include "frontend/import/formats.h"
#include "tools/driver/options.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

constexpr size_t kBeginning = 65536;  // enough to recognise the kind of a file

bool isBelow(const fs::path& folder, const fs::path& file) {
  std::error_code ignored;
  const fs::path relative = fs::relative(file, folder, ignored);
  return !relative.empty() && *relative.begin() != "..";
}

bool holdsSource(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kBeginning, '\0');
  file.read(text.data(), kBeginning);
  text.resize(static_cast<size_t>(file.gcount()));
  const importer::FileKind kind = importer::kindOf(path, text);
  return importer::holdsProgram(kind) || importer::isProject(kind) ||
         importer::roleOf(kind) == importer::FileRole::Messages;
}

}  // namespace

std::string checkOutputs(const std::vector<std::string>& inputs, const std::vector<Output>& outputs) {
  for (const Output& output : outputs) {
    std::error_code ignored;
    if (output.path.empty() || output.path == "-" || !fs::is_regular_file(output.path, ignored)) continue;
    for (const std::string& input : inputs) {
      const bool is_input = fs::equivalent(output.path, input, ignored);
      const bool in_input =
          !is_input && fs::is_directory(input, ignored) && isBelow(input, output.path) && holdsSource(output.path);
      if (is_input || in_input)
        return backquoted(output.option + ' ' + output.path) + " would replace a source; write to another file";
    }
  }
  return {};
}

}  // namespace rung::driver
