// SPDX-License-Identifier: Apache-2.0
// See native.h.
#include "native.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "codegen/write.h"

namespace rung::codegen {

namespace {

NativeResult command(const std::string& line) {
  NativeResult result;
  FILE* pipe = popen((line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> buffer;
  for (size_t got; (got = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) result.output.append(buffer.data(), got);
  const int status = pclose(pipe);
  result.ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return result;
}

}  // namespace

#ifdef RUNG_SANITIZED
constexpr const char* kSanitizers = " -fsanitize=address,undefined";  // as the runtime
#else
constexpr const char* kSanitizers = "";
#endif

NativeResult runNatively(const ir::Module& module, const std::string& driver, const std::string& flags) {
  std::string folder = (std::filesystem::temp_directory_path() / "rung-codegen-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};
  std::vector<OutputFile> files = emitCpp(module, {});
  std::string sources = " driver.cpp";
  for (const OutputFile& file : files) {
    if (file.path.ends_with(".cpp")) sources += " " + file.path;
  }
  files.push_back({"driver.cpp", driver});
  NativeResult result;
  result.output = writeOutputs(folder, files).error;
  if (result.output.empty()) {
    result = command("cd " + folder +
                     " && " RUNG_COMPILER
                     " -std=c++17 -Wall -Wextra -Werror -fno-rtti "
                     "-ffp-contract=off " +
                     flags + kSanitizers + " -I. -I" RUNG_INCLUDE + sources + " " RUNG_RUNTIME " -o program");
  }
  if (result.ok) result = command(folder + "/program");
  std::filesystem::remove_all(folder);
  return result;
}

}  // namespace rung::codegen
