// SPDX-License-Identifier: Apache-2.0
// The private cache of compiled C++; see cache.h.
#include "tools/driver/cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <vector>

#include "frontend/source/files.h"
#include "tools/driver/output_files.h"

namespace rung::driver {
namespace {

namespace fs = std::filesystem;

// Younger entries stay: another rung may have looked them up and be about to link them.
constexpr time_t kInUseSeconds = 600;
constexpr time_t kAbandonedSeconds = 24 * 3600;

uint64_t mix(uint64_t a, uint64_t b) {
  unsigned __int128 product = static_cast<unsigned __int128>(a) * b;
  return static_cast<uint64_t>(product) ^ static_cast<uint64_t>(product >> 64);
}

constexpr char kSeal[] = ".hash";

// Empty: the file cannot be read.
std::string hashOfFile(const std::string& path) {
  const ReadResult read = readFile(path);
  if (!read.error.empty()) return {};
  Hash hash;
  hash.add(read.content);
  return hash.hex();
}

bool makeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  return access(path.c_str(), W_OK | X_OK) == 0;
}

std::string wantedFolder() {
  if (const char* dir = std::getenv("RUNG_CACHE_DIR"); dir != nullptr && dir[0] != '\0') return dir;
  if (const char* dir = std::getenv("XDG_CACHE_HOME"); dir != nullptr && dir[0] == '/')
    return std::string(dir) + "/rung";
  if (const char* home = std::getenv("HOME"); home != nullptr && home[0] == '/')
    return std::string(home) + "/.cache/rung";
  return {};
}

}  // namespace

void Hash::add(std::string_view bytes) {
  add(bytes.size());
  const char* p = bytes.data();
  size_t left = bytes.size();
  uint64_t w[2];
  for (; left >= 16; left -= 16, p += 16) {
    memcpy(w, p, 16);
    a_ = mix(a_ ^ w[0] ^ 0xa0761d6478bd642full, w[1] ^ 0xe7037ed1a0b428dbull);
    b_ = mix(b_ ^ w[1] ^ 0x8ebc6af09c88c6e3ull, w[0] ^ 0x589965cc75374cc3ull) + a_;
  }
  w[0] = w[1] = 0;
  memcpy(w, p, left);
  a_ = mix(a_ ^ w[0] ^ 0xa0761d6478bd642full, w[1] ^ 0xe7037ed1a0b428dbull);
  b_ = mix(b_ ^ w[1] ^ 0x8ebc6af09c88c6e3ull, w[0] ^ 0x589965cc75374cc3ull) + a_;
}

void Hash::add(uint64_t number) {
  a_ = mix(a_ ^ number, 0x9e3779b97f4a7c15ull);
  b_ = mix(b_ + number, 0xc2b2ae3d27d4eb4full) ^ a_;
}

std::string Hash::hex() const {
  uint64_t words[2] = {mix(a_, 0x2127599bf4325c37ull) ^ b_, mix(b_, 0x880355f21e6d1965ull) + a_};
  std::string out;
  for (uint64_t word : words)
    for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[(word >> shift) & 15];
  return out;
}

Cache::Cache() {
  folder_ = wantedFolder();
  if (!folder_.empty() && makeFolder(folder_) && makeFolder(folder_ + "/work")) {
    // The compilers run in another folder.
    std::error_code error;
    folder_ = fs::absolute(folder_, error).lexically_normal().generic_string();
    return;
  }
  const char* base = std::getenv("TMPDIR");
  std::string pattern = std::string(base != nullptr && base[0] == '/' ? base : "/tmp") + "/rung-XXXXXX";
  folder_ = mkdtemp(pattern.data()) != nullptr ? pattern : "";
  temporary_ = true;
  if (!folder_.empty()) makeFolder(folder_ + "/work");
}

Cache::~Cache() {
  if (folder_.empty()) return;
  if (temporary_) {
    std::error_code error;
    fs::remove_all(folder_, error);
  } else if (added_) {
    trim(limitBytes());
  }
}

std::string Cache::path(const std::string& key, const char* kind) const {
  return folder_ + "/" + kind + "/" + key.substr(0, 2) + "/" + key.substr(2) + "." + kind;
}

bool Cache::has(const std::string& entry) const {
  const std::string seal = entry + kSeal;
  if (utimensat(AT_FDCWD, entry.c_str(), nullptr, 0) != 0) return false;
  const ReadResult sealed = readFile(seal);
  if (sealed.error.empty() && sealed.content == hashOfFile(entry)) {
    utimensat(AT_FDCWD, seal.c_str(), nullptr, 0);
    return true;
  }
  unlink(entry.c_str());
  return false;
}

bool Cache::put(const std::string& from, const std::string& entry) {
  added_ = true;
  makeFolder(entry.substr(0, entry.rfind('/')));
  const std::string hash = hashOfFile(from);
  return !hash.empty() && writeFile(entry + kSeal, hash).empty() && rename(from.c_str(), entry.c_str()) == 0;
}

std::string Cache::workFolder() {
  std::string pattern = folder_ + "/work/" + std::to_string(getpid()) + "-" + std::to_string(next_work_++) + "-XXXXXX";
  return mkdtemp(pattern.data()) != nullptr ? pattern : "";
}

void Cache::drop(const std::string& work_folder) {
  std::error_code error;
  if (work_folder.starts_with(folder_ + "/work/")) fs::remove_all(work_folder, error);
}

uint64_t Cache::limitBytes() {
  uint64_t mebibytes = 1024;
  if (const char* size = std::getenv("RUNG_CACHE_SIZE")) {
    char* end = nullptr;
    unsigned long long wanted = strtoull(size, &end, 10);
    if (end != size && *end == '\0' && wanted <= (1u << 20)) mebibytes = wanted;
  }
  return mebibytes << 20;
}

void Cache::trim(uint64_t limit) {
  struct Entry {
    time_t used;
    uint64_t size;
    std::string path;
  };
  std::vector<Entry> entries;
  uint64_t total = 0;
  const time_t now = time(nullptr);
  std::error_code error;
  // When another rung empties a folder at this moment, the walk ends early and the run continues.
  for (fs::recursive_directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
    const std::string path = it->path().string();
    struct stat info;
    if (stat(path.c_str(), &info) != 0) continue;
    if (it.depth() == 0 && it->path().filename() == "work") {
      it.disable_recursion_pending();
      continue;
    }
    if (!S_ISREG(info.st_mode)) continue;
    entries.push_back({info.st_mtime, static_cast<uint64_t>(info.st_blocks) * 512, path});
    total += entries.back().size;
  }
  std::error_code work_error;
  for (fs::directory_iterator it(folder_ + "/work", work_error), end; !work_error && it != end;
       it.increment(work_error)) {
    struct stat info;
    if (stat(it->path().c_str(), &info) == 0 && now - info.st_mtime > kAbandonedSeconds) {
      std::error_code ignored;
      fs::remove_all(it->path(), ignored);
    }
  }
  if (total <= limit) return;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= limit || now - entry.used < kInUseSeconds) break;
    if (unlink(entry.path.c_str()) == 0) total -= entry.size;
  }
}

}  // namespace rung::driver
