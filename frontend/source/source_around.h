// SPDX-License-Identifier: Apache-2.0
// The source around a location, for edits: its text, and offsets in it beside locations. In: a location of a file. Out:
// the text of that file; empty: the location is in none.
#pragma once

#include <string_view>

#include "frontend/source/files.h"
#include "frontend/source/scanner.h"

namespace rung {

class SourceAround {
 public:
  SourceAround(const Sources& sources, Loc loc) {
    const FileId file = sources.fileOf(loc);
    if (!file) return;
    source_ = sources.original(file);
    base_ = sources.begin(file).offset;
  }

  std::string_view source() const { return source_; }
  size_t at(Loc loc) const { return loc.offset - base_; }
  Loc loc(size_t at) const { return {base_ + static_cast<uint32_t>(at)}; }
  size_t size() const { return source_.size(); }
  // After the end, the end of a line.
  char operator[](size_t at) const { return at < source_.size() ? source_[at] : '\n'; }
  // A blank that does not end the line.
  bool isSpace(size_t at) const { return (*this)[at] == ' ' || (*this)[at] == '\t'; }
  // The end of a declaration with its `;`.
  size_t pastSemicolon(size_t end) const {
    size_t at = end;
    while (at < size() && isBlankCharacter(source_[at])) ++at;
    return (*this)[at] == ';' && (end == 0 || source_[end - 1] != ';') ? at + 1 : end;
  }

 private:
  std::string_view source_;
  uint32_t base_ = 0;
};

}  // namespace rung
