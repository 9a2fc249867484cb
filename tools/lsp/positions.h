// SPDX-License-Identifier: Apache-2.0
// Positions as the protocol counts them: lines from 0, and characters of a line in UTF-16 units or in bytes. In: a
// text. Out: the byte of a position, and the position of a byte. What lies beyond a line or the text is its end.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace rung::lsp {

enum class Encoding : uint8_t { Utf8, Utf16 };

struct Position {
  uint32_t line = 0, character = 0;
  friend bool operator==(Position, Position) = default;
};

class Positions {
 public:
  Positions(std::string_view text, Encoding encoding);

  uint32_t byteOf(Position position) const;
  Position positionOf(uint32_t byte) const;
  uint32_t lineCount() const { return static_cast<uint32_t>(starts_.size()); }

 private:
  std::string_view lineAt(uint32_t line) const;  // without its end

  std::string_view text_;
  Encoding encoding_;
  std::vector<uint32_t> starts_;
  // The last answer, from which the next one on its line goes on: a line may be a whole file.
  struct Counted {
    uint32_t line = 0, byte = 0, units = 0;
  };
  mutable Counted last_;
};

// The length of a text in units of the encoding.
uint32_t unitsOf(std::string_view text, Encoding encoding);

}  // namespace rung::lsp
