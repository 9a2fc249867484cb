// SPDX-License-Identifier: Apache-2.0
// The memory of a tree of C++: see nodes.h.
#include "codegen/cxx/nodes.h"

#include <algorithm>
#include <charconv>

namespace rung::codegen::cxx {

bool same(Ex a, Ex b) {
  if (a == b) return true;
  return a->kind == b->kind && a->op == b->op && a->text == b->text &&
         std::equal(a->operands.begin(), a->operands.end(), b->operands.begin(), b->operands.end(), same);
}

void Arena::beginChunk(size_t bytes) {
  constexpr size_t kChunk = 32 * 1024;
  if (current_ < chunks_.size()) ++current_;
  while (current_ < chunks_.size() && chunks_[current_].size < bytes) ++current_;
  if (current_ == chunks_.size()) {
    const size_t size = std::max(bytes, kChunk);
    chunks_.push_back({std::unique_ptr<unsigned char[]>(new unsigned char[size]), size});
  }
  used_ = 0;
}

void Tree::clear() {
  arena_.clear();
  files_.clear();
}

Ex Tree::number(uint64_t value, std::string_view suffix) {
  char digits[32];
  char* end = std::to_chars(digits, digits + 21, value).ptr;
  end = std::copy(suffix.begin(), suffix.end(), end);
  return constant({digits, static_cast<size_t>(end - digits)}, false);
}

Ex Tree::signedNumber(int64_t value, std::string_view suffix) {
  char digits[32];
  char* end = std::to_chars(digits, digits + 21, value).ptr;
  end = std::copy(suffix.begin(), suffix.end(), end);
  return constant({digits, static_cast<size_t>(end - digits)}, value < 0);
}

uint32_t Tree::file(std::string_view path) {
  const auto found = std::find(files_.begin(), files_.end(), path);
  if (found == files_.end()) {
    files_.push_back(kept(path));
    return static_cast<uint32_t>(files_.size() - 1);
  }
  return static_cast<uint32_t>(found - files_.begin());
}

}  // namespace rung::codegen::cxx
