// SPDX-License-Identifier: Apache-2.0
// Interning of identifiers: a chained hash table over the case-folded spelling. A hit costs one hash, one bucket and
// one comparison and allocates nothing. All spellings of an identifier are in one chain, so a miss finds its key there.
// Lexers call this for every identifier: it is on the hot path of the compiler.
#include "frontend/source/names.h"

#include <cstring>

namespace rung {
namespace {

constexpr size_t kBlockBytes = 64 * 1024;

template <class Word>
uint64_t load(const char* at) {
  Word word = 0;
  std::memcpy(&word, at, sizeof word);
  return word;
}

// Up to seven bytes without a loop: two loads that may overlap.
uint64_t loadShort(const char* at, size_t count) {
  if (count >= 4) return load<uint32_t>(at) | load<uint32_t>(at + count - 4) << 32;
  if (count >= 2) return load<uint16_t>(at) | load<uint16_t>(at + count - 2) << 16;
  return count == 1 ? static_cast<unsigned char>(*at) : 0;
}

// Setting bit 5 of every byte folds letters. It also folds some other characters together, which costs collisions but
// no wrong answers.
uint32_t foldedHash(std::string_view spelling) {
  constexpr uint64_t kFold = 0x2020202020202020u;
  const auto mix = [](uint64_t hash, uint64_t word) {
    hash = (hash ^ (word | kFold)) * 0xff51afd7ed558ccdu;
    return hash ^ hash >> 32;
  };
  const char* at = spelling.data();
  const size_t size = spelling.size();
  uint64_t hash = size * 0x9e3779b97f4a7c15u;
  if (size < 8) {
    hash = mix(hash, loadShort(at, size));
  } else {
    const char* const last = at + size - 8;
    for (; at < last; at += 8) hash = mix(hash, load<uint64_t>(at));
    hash = mix(hash, load<uint64_t>(last));
  }
  hash *= 0xc4ceb9fe1a85ec53u;
  return static_cast<uint32_t>(hash ^ hash >> 32);
}

}  // namespace

bool sameIdentifier(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && foldedCharacter(a[i]) != foldedCharacter(b[i])) return false;
  }
  return true;
}

std::string foldedIdentifier(std::string_view spelling) {
  std::string result(spelling);
  for (char& c : result) c = foldedCharacter(c);
  return result;
}

Names::Names() : entries_(1), buckets_(1024) { entries_.reserve(1024); }

NameId Names::intern(std::string_view spelling) {
  if (spelling.empty()) return {};
  const uint32_t hash = foldedHash(spelling);
  NameId key;
  for (uint32_t i = buckets_[hash & (buckets_.size() - 1)]; i != 0; i = entries_[i].next) {
    const Entry& entry = entries_[i];
    if (entry.hash != hash || entry.spelling.size() != spelling.size()) continue;
    if (std::memcmp(entry.spelling.data(), spelling.data(), spelling.size()) == 0) return {i};
    if (!key && sameIdentifier(entry.spelling, spelling)) key = entry.key;
  }

  if (entries_.size() > buckets_.size()) grow();
  const NameId id{count()};
  uint32_t& bucket = buckets_[hash & (buckets_.size() - 1)];
  entries_.push_back({store(spelling), key ? key : id, hash, bucket});
  bucket = id.index;
  return id;
}

NameId Names::find(std::string_view spelling) const {
  if (spelling.empty()) return {};
  const uint32_t hash = foldedHash(spelling);
  for (uint32_t i = buckets_[hash & (buckets_.size() - 1)]; i != 0; i = entries_[i].next) {
    if (entries_[i].hash == hash && sameIdentifier(entries_[i].spelling, spelling)) return entries_[i].key;
  }
  return {};
}

void Names::grow() {
  buckets_.assign(buckets_.size() * 4, 0);
  for (uint32_t i = 1; i < entries_.size(); ++i) {
    uint32_t& bucket = buckets_[entries_[i].hash & (buckets_.size() - 1)];
    entries_[i].next = bucket;
    bucket = i;
  }
}

// Blocks never grow past their reservation, so the string views handed out stay valid.
std::string_view Names::store(std::string_view spelling) {
  if (storage_.empty() || storage_.back().capacity() - storage_.back().size() < spelling.size()) {
    storage_.emplace_back().reserve(spelling.size() > kBlockBytes ? spelling.size() : kBlockBytes);
  }
  std::vector<char>& block = storage_.back();
  const size_t start = block.size();
  block.insert(block.end(), spelling.begin(), spelling.end());
  return {block.data() + start, spelling.size()};
}

namespace {

// The length of the suffix with which the device tree of CODESYS shows the kind of an object: ` (GVL)`. A number, as in
// `Plant (2)`, tells copies apart.
size_t kindSuffix(std::string_view stem) {
  if (stem.empty() || stem.back() != ')') return 0;
  const size_t open = stem.rfind('(');
  if (open == std::string_view::npos || open == 0 || open + 2 == stem.size()) return 0;
  for (const char c : stem.substr(open + 1, stem.size() - open - 2))
    if (foldedCharacter(c) < 'a' || foldedCharacter(c) > 'z') return 0;
  const size_t end = stem.find_last_not_of(' ', open - 1);
  return end == std::string_view::npos ? 0 : stem.size() - end - 1;
}

}  // namespace

std::string listNameOf(std::string_view path) {
  const size_t slash = path.find_last_of("/\\");
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  const size_t dot = path.find_last_of('.');
  if (dot != std::string_view::npos && dot > 0) path = path.substr(0, dot);
  path.remove_suffix(kindSuffix(path));
  std::string name;
  for (const char c : path) {
    const bool ok = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += ok ? c : '_';
  }
  if (name.empty() || (name[0] >= '0' && name[0] <= '9')) name = "globals_" + name;
  return name;
}

}  // namespace rung
