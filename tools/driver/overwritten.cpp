// SPDX-License-Identifier: Apache-2.0
// See overwritten.h. A source is a file that the command line names, and in a folder that it names any file that holds
// a program or the messages of one; results of an earlier run are replaced, in a folder of sources too.
#include "tools/driver/overwritten.h"

#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "frontend/import/formats.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

constexpr size_t kBeginning = 65536;  // enough to recognise the kind of a file

struct Output {
  std::string option, path;
};

std::vector<Output> outputsOf(const Options& options) {
  std::vector<Output> all = {{"-o", options.output},         {"--diagnostics", options.diagnostics_path},
                             {"--depfile", options.depfile}, {"--symbols", options.symbols},
                             {"--junit", options.junit},     {"--lcov", options.lcov}};
  for (const std::string& argument : options.host_arguments)
    for (const char* const option : {"--trace", "--plot", "--retain"})
      if (argument.starts_with(std::string(option) + "="))
        all.push_back({option, argument.substr(std::string_view(option).size() + 1)});
  return all;
}

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

std::string checkOutputs(const Options& options) {
  for (const Output& output : outputsOf(options)) {
    std::error_code ignored;
    if (output.path.empty() || output.path == "-" || !fs::is_regular_file(output.path, ignored)) continue;
    for (const std::string& input : options.inputs) {
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
