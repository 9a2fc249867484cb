// SPDX-License-Identifier: Apache-2.0
// Names: every identifier is interned once. A NameId denotes one exact spelling; key(id) is the id that all spellings
// of the same identifier share (IEC identifiers are not case-sensitive), so scopes hash keys while messages print what
// the user wrote. In: spellings from lexers and readers. Out: 32-bit ids. Called by every layer.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/text.h"

namespace rung {

struct NameId {
  uint32_t index = 0;  // 0: no name
  explicit operator bool() const { return index != 0; }
  friend bool operator==(NameId, NameId) = default;
};

class Names {
 public:
  Names();
  Names(const Names&) = delete;
  Names& operator=(const Names&) = delete;

  NameId intern(std::string_view spelling);

  // The id of the identifier of this spelling if any of its spellings was interned, else none.
  NameId find(std::string_view spelling) const;

  std::string_view string(NameId id) const { return entries_[id.index].spelling; }

  // The id shared by all spellings of an identifier: that of the first one interned.
  NameId key(NameId id) const { return entries_[id.index].key; }
  bool same(NameId a, NameId b) const { return key(a) == key(b); }

  uint32_t count() const { return static_cast<uint32_t>(entries_.size()); }

 private:
  struct Entry {
    std::string_view spelling;
    NameId key;
    uint32_t hash;  // of the folded spelling
    uint32_t next;  // chain in the bucket, 0: end
  };
  void grow();
  std::string_view store(std::string_view spelling);

  std::vector<Entry> entries_;
  std::vector<uint32_t> buckets_;
  std::deque<std::vector<char>> storage_;
};

// True when the two spellings are the same IEC identifier (ASCII case folded).
bool sameIdentifier(std::string_view a, std::string_view b);
// The spelling in lower case: equal for equal identifiers, and the collation order that the dialects use.
std::string foldedIdentifier(std::string_view spelling);
// The name of the global list that a file defines: the stem of its path, as an identifier.
std::string listNameOf(std::string_view path);

}  // namespace rung
