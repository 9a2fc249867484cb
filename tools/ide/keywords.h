// SPDX-License-Identifier: Apache-2.0
// The words of the language, from the table of tokens, for editors.
#pragma once

#include <span>
#include <string_view>

namespace rung::ide {

enum class WordKind : uint8_t { None, Keyword, Type, Soft };  // Soft: a keyword only where the grammar asks for it

struct Word {
  std::string_view spelling;
  WordKind kind;
};
std::span<const Word> words();
// Any case.
WordKind kindOfWord(std::string_view word);

}  // namespace rung::ide
