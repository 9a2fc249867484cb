// Output files on disk: see write.h. Every new content is first written under a temporary name beside its file; only
// when all are there, they are renamed, one by one, and the manifest last.
#include "codegen/write.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace rung::codegen {

namespace {

constexpr const char* kManifest = "rung.manifest";

std::string systemError(const std::string& path) { return path + ": " + std::strerror(errno); }

// Creates a folder and those above it.
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
  bool good = fstat(file, &info) == 0 && S_ISREG(info.st_mode);
  if (good) {
    content.resize(static_cast<size_t>(info.st_size));
    size_t at = 0;
    while (at < content.size()) {
      const ssize_t got = read(file, content.data() + at, content.size() - at);
      if (got <= 0) break;
      at += static_cast<size_t>(got);
    }
    good = at == content.size();
  }
  close(file);
  return good;
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
  const bool good = at == content.size();
  if (close(file) != 0) return false;
  if (!good) errno = failure;
  return good;
}

// A name of the manifest that is a plain relative path below the folder; whatever else stands there is left alone.
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

}  // namespace

WriteResult writeOutputs(const std::string& folder, const std::vector<OutputFile>& files) {
  WriteResult result;
  if (!makeFolder(folder)) {
    result.error = systemError(folder);
    return result;
  }
  const std::string base = folder.empty() ? "" : folder + "/";
  const std::string suffix = ".rung-" + std::to_string(getpid());

  std::vector<std::string> names;
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
  for (const OutputFile& file : files) {
    names.push_back(file.path);
    if (!stage(file.path, file.content)) return giveUp(base + file.path);
  }
  std::sort(names.begin(), names.end());
  std::string manifest, old_manifest;
  for (const std::string& name : names) {
    manifest += name;
    manifest += '\n';
  }
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
