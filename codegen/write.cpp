// SPDX-License-Identifier: Apache-2.0
// Output files on disk: see write.h. A new folder is filled under a temporary name and renamed as a whole. In an old
// one every new content is first written beside its file; once all are there they are renamed, the manifest last.
// A temporary name ends in the process id; the next run removes what a killed process left.
#include "codegen/write.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace rung::codegen {

namespace {

constexpr const char* kManifest = "rung.manifest";
constexpr std::string_view kUnfinished = ".rung-";

std::string unfinishedSuffix() { return std::string(kUnfinished) + std::to_string(getpid()); }

// Signals that end the process wait until the files are complete, some milliseconds.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, number);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

// Removes NAME.rung-PID of the folder when that process is gone; `names` are sorted.
void removeAbandoned(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<std::string> abandoned;
  DIR* const dir = opendir(folder.empty() ? "." : folder.c_str());
  if (dir == nullptr) return;
  while (const dirent* entry = readdir(dir)) {
    const std::string_view name = entry->d_name;
    const size_t at = name.rfind(kUnfinished);
    if (at == std::string_view::npos || at + kUnfinished.size() == name.size()) continue;
    const std::string process(name.substr(at + kUnfinished.size()));
    if (process.size() > 9 || process.find_first_not_of("0123456789") != std::string::npos) continue;
    if (kill(static_cast<pid_t>(std::stol(process)), 0) == 0 || errno != ESRCH) continue;
    if (std::binary_search(names.begin(), names.end(), name.substr(0, at))) abandoned.emplace_back(name);
  }
  closedir(dir);
  for (const std::string& name : abandoned) unlink((folder.empty() ? name : folder + "/" + name).c_str());
}

std::string systemError(const std::string& path) { return path + ": " + std::strerror(errno); }

// Creates a folder and its parents.
bool makeFolder(const std::string& path) {
  if (path.empty()) return true;
  struct stat info;
  if (stat(path.c_str(), &info) == 0) {
    if (S_ISDIR(info.st_mode)) return true;
    errno = ENOTDIR;
    return false;
  }
  const size_t slash = path.find_last_of('/');
  if (slash != std::string::npos && slash > 0 && !makeFolder(path.substr(0, slash))) return false;
  return mkdir(path.c_str(), 0777) == 0 || errno == EEXIST;
}

bool readWhole(const std::string& path, std::string& content) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  struct stat info;
  bool ok = fstat(file, &info) == 0 && S_ISREG(info.st_mode);
  if (ok) {
    content.resize(static_cast<size_t>(info.st_size));
    size_t at = 0;
    while (at < content.size()) {
      const ssize_t got = read(file, content.data() + at, content.size() - at);
      if (got <= 0) break;
      at += static_cast<size_t>(got);
    }
    ok = at == content.size();
  }
  close(file);
  return ok;
}

// True when the file has exactly this content; its size decides most cases without reading.
bool isEqual(const std::string& path, const std::string& content) {
  struct stat info;
  if (stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode) || static_cast<size_t>(info.st_size) != content.size()) {
    return false;
  }
  std::string old;
  return readWhole(path, old) && old == content;
}

bool writeWhole(const std::string& path, const std::string& content) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return false;
  size_t at = 0;
  while (at < content.size()) {
    const ssize_t put = write(file, content.data() + at, content.size() - at);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) break;
    at += static_cast<size_t>(put);
  }
  const int failure = errno;
  const bool ok = at == content.size();
  if (close(file) != 0) return false;
  if (!ok) errno = failure;
  return ok;
}

// A name in the manifest that is a plain relative path below the folder; all others are left alone.
bool isOurs(std::string_view path) {
  if (path.empty() || path[0] == '/') return false;
  for (size_t at = 0; at <= path.size();) {
    size_t end = path.find('/', at);
    if (end == std::string_view::npos) end = path.size();
    const std::string_view part = path.substr(at, end - at);
    if (part.empty() || part == "." || part == "..") return false;
    at = end + 1;
  }
  return true;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  for (size_t at = 0; at < text.size();) {
    size_t end = text.find('\n', at);
    if (end == std::string::npos) end = text.size();
    if (end > at) result.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return result;
}

std::string manifestOf(const std::vector<OutputFile>& files, std::vector<std::string>& names) {
  for (const OutputFile& file : files) names.push_back(file.path);
  std::sort(names.begin(), names.end());
  std::string manifest;
  for (const std::string& name : names) {
    manifest += name;
    manifest += '\n';
  }
  return manifest;
}

// Fills a folder that does not exist yet: no temporary names, no check for existing files.
WriteResult writeNewFolder(const std::string& folder, const std::vector<OutputFile>& files) {
  WriteResult result;
  const std::string created = folder + unfinishedSuffix();
  if (!makeFolder(created)) {
    result.error = systemError(folder);
    return result;
  }
  auto giveUp = [&](const std::string& path) {
    result.error = systemError(path);
    for (const std::string& name : result.written) unlink((created + "/" + name).c_str());
    rmdir(created.c_str());  // fails when it has subfolders of its own, which are empty
    result.written.clear();
    return result;
  };
  std::vector<std::string> names;
  const std::string manifest = manifestOf(files, names);
  auto put = [&](const std::string& name, const std::string& content) {
    const size_t slash = name.find_last_of('/');
    if (slash != std::string::npos && !makeFolder(created + "/" + name.substr(0, slash))) return false;
    result.written.push_back(name);
    return writeWhole(created + "/" + name, content);
  };
  for (const OutputFile& file : files) {
    if (!put(file.path, file.content)) return giveUp(folder + "/" + file.path);
  }
  if (!put(kManifest, manifest)) return giveUp(folder + "/" + kManifest);
  if (rename(created.c_str(), folder.c_str()) != 0) return giveUp(folder);
  return result;
}

}  // namespace

WriteResult writeOutputs(const std::string& folder, const std::vector<OutputFile>& files) {
  const HeldSignals held;
  struct stat info;
  if (!folder.empty() && folder.back() != '/' && lstat(folder.c_str(), &info) != 0 && errno == ENOENT) {
    return writeNewFolder(folder, files);
  }
  WriteResult result;
  if (!makeFolder(folder)) {
    result.error = systemError(folder);
    return result;
  }
  const std::string base = folder.empty() ? "" : folder + "/";
  const std::string suffix = unfinishedSuffix();

  std::vector<std::string> names;
  const std::string manifest = manifestOf(files, names);
  std::vector<std::pair<std::string, std::string>> renames;  // from, to
  auto giveUp = [&](const std::string& path) {
    result.error = systemError(path);
    for (const auto& [from, to] : renames) unlink(from.c_str());
    result.written.clear();
    result.kept.clear();
    return result;
  };
  auto stage = [&](const std::string& name, const std::string& content) {
    const std::string path = base + name;
    if (isEqual(path, content)) {
      result.kept.push_back(name);
      return true;
    }
    const size_t slash = name.find_last_of('/');
    if (slash != std::string::npos && !makeFolder(base + name.substr(0, slash))) return false;
    renames.push_back({path + suffix, path});
    if (!writeWhole(renames.back().first, content)) return false;
    result.written.push_back(name);
    return true;
  };
  removeAbandoned(folder, names);
  for (const OutputFile& file : files) {
    if (!stage(file.path, file.content)) return giveUp(base + file.path);
  }
  std::string old_manifest;
  readWhole(base + kManifest, old_manifest);
  if (!stage(kManifest, manifest)) return giveUp(base + kManifest);

  for (size_t i = 0; i < renames.size(); ++i) {
    if (rename(renames[i].first.c_str(), renames[i].second.c_str()) == 0) continue;
    const std::string failed = systemError(renames[i].second);
    for (size_t k = i; k < renames.size(); ++k) unlink(renames[k].first.c_str());
    result.error = failed;
    return result;
  }
  for (const std::string& old : lines(old_manifest)) {
    if (!isOurs(old) || std::binary_search(names.begin(), names.end(), old)) continue;
    if (unlink((base + old).c_str()) == 0) result.deleted.push_back(old);
  }
  return result;
}

std::string depfile(const std::string& target, const std::vector<std::string>& sources) {
  auto escaped = [](const std::string& path) {
    std::string out;
    for (char c : path) {
      if (c == ' ' || c == '#' || c == '\\') out += '\\';
      if (c == '$') out += '$';
      out += c;
    }
    return out;
  };
  std::string out = escaped(target) + ":";
  for (const std::string& source : sources) out += " \\\n  " + escaped(source);
  out += '\n';
  return out;
}

}  // namespace rung::codegen
