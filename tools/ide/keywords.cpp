// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/keywords.h"

#include "frontend/source/names.h"

namespace rung::ide {
namespace {

// S and R of `S=` are names wherever they could be completed or coloured.
constexpr Word kLanguage[] = {
#define RUNG_WORD(name, spelling) {spelling, WordKind::Keyword},
#define RUNG_TYPE_WORD(name, spelling) {spelling, WordKind::Type},
#define RUNG_SOFT_WORD(name, spelling) {spelling, WordKind::Soft},
#include "frontend/parse/tokens.def"
};

}  // namespace

std::span<const Word> words() { return kLanguage; }

WordKind kindOfWord(std::string_view word) {
  for (const Word& candidate : kLanguage)
    if (candidate.spelling.size() == word.size() && candidate.spelling.size() > 1 &&
        sameIdentifier(candidate.spelling, word))
      return candidate.kind;
  return WordKind::None;
}

}  // namespace rung::ide
