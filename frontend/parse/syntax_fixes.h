// SPDX-License-Identifier: Apache-2.0
// How words are put into a source, and taken out of it, by the fixes of the parser. In: the source, and the bytes
// between two tokens. Out: where the word goes, and its blanks and line ends. Called by the parser and the block
// repair.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rung::text {

struct Insertion {
  size_t at;
  std::string text;
};

// A word or sign after the token that ends at `after`: ` THEN`, `)`.
Insertion insertedAfter(std::string_view source, size_t after, std::string_view word);
// … in place of the bytes from `begin` to `end`: `NOT ` for the sign of `!a`.
std::string inPlaceOf(std::string_view source, size_t begin, size_t end, std::string_view word);
// END_… of a block whose first word is at `open`, between the tokens that end at `after` and begin at `before`: on a
// line of its own, unless all of it is on one line.
Insertion endOfBlock(std::string_view source, size_t open, size_t after, size_t before, std::string_view end_word);
// The blanks at the begin of a line.
std::string_view indentOf(std::string_view source, size_t at);
// The bytes to take away with a token: also the blanks before it.
size_t beginOfRemoval(std::string_view source, size_t token);

}  // namespace rung::text
