// SPDX-License-Identifier: Apache-2.0
#include "tools/driver/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "tools/driver/options.h"
#include "tools/driver/sink.h"

namespace rung::driver {

std::string writeFile(const std::string& path, const std::string& text, uint32_t permissions) {
  // Several threads may write, too.
  static std::atomic<uint32_t> count = 0;
  const std::string part = path + ".part" + std::to_string(getpid()) + "_" + std::to_string(++count);
  FILE* file = fopen(part.c_str(), "wb");
  if (file == nullptr) return "cannot write `" + path + "`: " + strerror(errno);
  bool ok = fwrite(text.data(), 1, text.size(), file) == text.size();
  ok = ok && (permissions == 0 || fchmod(fileno(file), permissions) == 0);
  ok = fclose(file) == 0 && ok;
  if (ok && rename(part.c_str(), path.c_str()) == 0) return {};
  std::string error = "cannot write `" + path + "`: " + strerror(errno);
  unlink(part.c_str());
  return error;
}

int writeFiles(const std::string& folder, const std::vector<TextFile>& files, Sink& sink) {
  for (const TextFile& file : files) {
    const std::filesystem::path path = std::filesystem::path(folder) / file.path;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    const std::string created =
        error ? "cannot create the folder `" + path.parent_path().string() + "`: " + error.message() : "";
    const std::string problem = error ? created : writeFile(path.string(), file.text);
    if (problem.empty()) continue;
    sink.error(problem);
    return kUsage;
  }
  return kSuccess;
}

}  // namespace rung::driver
