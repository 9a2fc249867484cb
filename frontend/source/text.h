// SPDX-License-Identifier: Apache-2.0
// Characters as bytes: the case of ASCII letters, and UTF-16 units of UTF-8. In: characters, or valid UTF-8. Called by
// every layer that folds, sorts, writes or measures text; identifiers are compared by names.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rung {

// An ASCII letter in lower or upper case, any other character as it is.
constexpr char foldedCharacter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

inline std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = upper(c);
  return result;
}

// The UTF-16 units of a UTF-8 string, one after the other; a character beyond 0xffff has two. 0 at the end.
class Utf16Units {
 public:
  explicit Utf16Units(std::string_view utf8) : text_(utf8) {}
  bool done() const { return low_surrogate_ == 0 && at_ >= text_.size(); }
  uint32_t next() {
    if (low_surrogate_ != 0) {
      const uint32_t unit = low_surrogate_;
      low_surrogate_ = 0;
      return unit;
    }
    if (at_ >= text_.size()) return 0;
    const uint32_t point = nextPoint();
    if (point < 0x10000) return point;
    low_surrogate_ = 0xdc00 + ((point - 0x10000) & 0x3ff);
    return 0xd800 + ((point - 0x10000) >> 10);
  }

 private:
  uint32_t byte(size_t at) const { return at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0u; }
  uint32_t nextPoint() {
    const size_t at = at_;
    const uint32_t lead = byte(at);
    if (lead >= 0xf0) {
      at_ += 4;
      return (lead & 7) << 18 | (byte(at + 1) & 63) << 12 | (byte(at + 2) & 63) << 6 | (byte(at + 3) & 63);
    }
    if (lead >= 0xe0) {
      at_ += 3;
      return (lead & 15) << 12 | (byte(at + 1) & 63) << 6 | (byte(at + 2) & 63);
    }
    at_ += lead >= 0xc0 ? 2 : 1;
    return lead >= 0xc0 ? (lead & 31) << 6 | (byte(at + 1) & 63) : lead;
  }

  std::string_view text_;
  size_t at_ = 0;
  uint32_t low_surrogate_ = 0;
};

}  // namespace rung
