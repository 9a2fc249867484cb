// SPDX-License-Identifier: Apache-2.0
// Output files that appear whole or not at all: see output_file.h.
#include "output_file.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace rung::host {
namespace {

constexpr size_t kMax = 4;         // unfinished files at the same time
constexpr size_t kLongest = 4096;  // characters of a path
char unfinished[kMax][kLongest];   // read by the handler
constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

void removeUnfinished(int number) {
  removeUnfinishedFiles();
  signal(number, SIG_DFL);
  raise(number);
}

void remember(const std::string& path) {
  for (auto& slot : unfinished) {
    if (slot[0] != '\0' || path.size() >= kLongest) continue;
    memcpy(slot, path.c_str(), path.size() + 1);
    break;
  }
  for (const int number : kSignals) {
    struct sigaction now;
    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;  // ignored, or handled by others
    struct sigaction action {};
    action.sa_handler = removeUnfinished;
    sigaction(number, &action, nullptr);
  }
}

void forget(const std::string& path) {
  for (auto& slot : unfinished)
    if (path == slot) slot[0] = '\0';
}

}  // namespace

void removeUnfinishedFiles() {
  for (const auto& path : unfinished)
    if (path[0] != '\0') unlink(path);
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && !standard_) fclose(file_);
  if (temporary_.empty()) return;
  unlink(temporary_.c_str());
  forget(temporary_);
}

bool OutputFile::open(const std::string& path, std::FILE* out, std::string& error) {
  path_ = path;
  standard_ = path == "-";
  if (standard_) {
    file_ = out;
    return true;
  }
  struct stat status;
  const bool regular = stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
  if (regular) {
    temporary_ = path + ".tmp" + std::to_string(getpid());
    remember(temporary_);
  }
  file_ = fopen(regular ? temporary_.c_str() : path.c_str(), "wb");
  if (file_ != nullptr) return true;
  error = path + ": " + strerror(errno);
  forget(temporary_);
  temporary_.clear();
  return false;
}

void OutputFile::write(const std::string& text) { fwrite(text.data(), 1, text.size(), file_); }

bool OutputFile::close(std::string& error) {
  bool ok = fflush(file_) == 0 && ferror(file_) == 0;
  if (!standard_) ok = fclose(file_) == 0 && ok;
  file_ = nullptr;
  if (ok && !temporary_.empty()) ok = rename(temporary_.c_str(), path_.c_str()) == 0;
  if (!ok) {
    error = path_ + ": " + strerror(errno);
    return false;
  }
  forget(temporary_);
  temporary_.clear();
  return true;
}

}  // namespace rung::host
