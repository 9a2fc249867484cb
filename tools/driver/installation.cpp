// SPDX-License-Identifier: Apache-2.0
// The installed parts of Rung; see installation.h.
#include "tools/driver/installation.h"

#include <sys/auxv.h>
#include <unistd.h>

#include <climits>
#include <cstdlib>

namespace rung::driver {
namespace {

bool exists(const std::string& path) { return access(path.c_str(), R_OK) == 0; }

std::string executableFolder() {
  char path[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
  if (length > 0) {
    path[length] = '\0';
  } else {  // no /proc, as in a bare chroot: the path that started it
    const auto* started = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
    if (started == nullptr || realpath(started, path) == nullptr) return {};
  }
  const std::string full = path;
  return full.substr(0, full.rfind('/'));
}

Installation find() {
  Installation found;
  std::string homes[3];
  if (const char* home = std::getenv("RUNG_HOME"); home != nullptr && home[0] != '\0') homes[0] = home;
  homes[1] = executableFolder() + "/..";
  const std::string include_folders[] = {homes[0].empty() ? "" : homes[0] + "/share/rung/include",
                                         homes[0].empty() ? "" : homes[0] + "/include",
                                         homes[1] + "/share/rung/include"};
  for (const std::string& folder : include_folders) {
    if (folder.empty() || !exists(folder + "/rung/module.h")) continue;
    found.include = folder;
    break;
  }
  const std::string library_folders[] = {homes[0].empty() ? "" : homes[0] + "/lib", homes[1] + "/lib",
                                         homes[1] + "/lib64"};
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

std::string camFitModule() {
  const char* const home = std::getenv("RUNG_HOME");
  const std::string root = home != nullptr && home[0] != '\0' ? home : executableFolder() + "/..";
  const std::string path = root + "/lib/rung/rung_cam_fit.so";
  return exists(path) ? path : "";
}

const char* version() { return RUNG_VERSION; }

}  // namespace rung::driver
