// The installed parts of Rung; see installation.h.
#include "tools/driver/installation.h"

#include <unistd.h>

#include <climits>
#include <cstdlib>

namespace rung::driver {
namespace {

bool exists(const std::string& path) { return access(path.c_str(), R_OK) == 0; }

std::string executableFolder() {
  char path[PATH_MAX];
  ssize_t length = readlink("/proc/self/exe", path, sizeof path);
  if (length <= 0) return {};
  std::string full(path, static_cast<size_t>(length));
  return full.substr(0, full.rfind('/'));
}

Installation find() {
  Installation found;
  std::string homes[3];
  if (const char* home = std::getenv("RUNG_HOME"); home != nullptr && home[0] != '\0') homes[0] = home;
  homes[1] = executableFolder() + "/..";
  const std::string include_folders[] = {homes[0].empty() ? "" : homes[0] + "/share/rung/include",
                                         homes[0].empty() ? "" : homes[0] + "/include",
                                         homes[1] + "/share/rung/include", RUNG_BUILD_INCLUDE};
  for (const std::string& folder : include_folders) {
    if (folder.empty() || !exists(folder + "/rung/module.h")) continue;
    found.include = folder;
    break;
  }
  const std::string library_folders[] = {homes[0].empty() ? "" : homes[0] + "/lib", homes[1] + "/lib",
                                         homes[1] + "/lib64", RUNG_BUILD_LIB};
  for (const std::string& folder : library_folders) {
    if (folder.empty() || !exists(folder + "/librung_runtime.a") || !exists(folder + "/librung_host.a")) continue;
    found.runtime_library = folder + "/librung_runtime.a";
    found.host_library = folder + "/librung_host.a";
    break;
  }
  if (found.include.empty() || found.runtime_library.empty())
    found.error = std::string("cannot find ") + (found.include.empty() ? "the headers" : "librung_runtime.a") +
                  " of the runtime next to the executable; set RUNG_HOME to the folder that contains lib/ and "
                  "share/rung/include/";
  return found;
}

}  // namespace

const Installation& installation() {
  static const Installation found = find();
  return found;
}

const char* version() { return RUNG_VERSION; }

}  // namespace rung::driver
