// SPDX-License-Identifier: Apache-2.0
// Command line of the tools for generated programs: see options.h.
#include "tests/fuzz/generated/options.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace rung::generated {

bool readOptions(int argc, char** argv, const char* tool, const char* taken, Options& options) {
  namespace fs = std::filesystem;
  std::error_code error;
  options.rung = (fs::read_symlink("/proc/self/exe", error).parent_path() / "rung").string();
  options.folder = (fs::temp_directory_path(error) / (std::string(tool) + "." + std::to_string(getpid()))).string();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    std::string name = word.substr(0, word.find('='));
    std::string value = word.substr(std::min(name.size() + 1, word.size()));
    if (word.compare(0, 2, "-j") == 0) {
      name = "-j";
      value = word.size() > 2 || i + 1 == argc ? word.substr(2) : argv[++i];
    }
    const uint64_t number = std::strtoull(value.c_str(), nullptr, 10);
    const auto is = [&](const char* known) { return name == known && std::strstr(taken, known) != nullptr; };
    if (name == "--first") {
      options.first = number;
    } else if (name == "--count") {
      options.count = number;
    } else if (name == "--rung") {
      options.rung = value;
    } else if (name == "--folder") {
      options.folder = value;
      options.keeps_folder = true;
    } else if (name == "--print") {
      options.has_print = true;
      options.print = number;
    } else if (is("--cycles")) {
      options.cycles = number;
    } else if (is("--ways")) {
      options.ways = value;
    } else if (is("--engine")) {
      options.engine = value;
    } else if (is("-j")) {
      options.jobs = std::clamp(static_cast<unsigned>(number), 1u, 64u);
    } else {
      std::fprintf(stderr, "%s: unknown option %s\n", tool, word.c_str());
      return false;
    }
  }
  return true;
}

}  // namespace rung::generated
