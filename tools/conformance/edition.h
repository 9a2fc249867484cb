// SPDX-License-Identifier: Apache-2.0
// Finds what a text has that an edition of the standard does not: by the grammar of its annex (B of edition 2, A of
// edition 3), its words, and the keywords that it reserves. In: plain source, as the exporter writes it. Out: the first
// such thing in words. Called for each case before it is kept.
#pragma once

#include <map>
#include <string>

#include "tools/conformance/source.h"

namespace rung::conformance {

// words.tsv and keywords.tsv.
struct Vocabulary {
  std::map<std::string, int> words;     // by word: the edition that has it first; 0: none
  std::map<std::string, int> keywords;  // by word: the last edition that reserves it
};
// The error names what could not be read.
[[nodiscard]] std::string readVocabulary(const std::string& root, Vocabulary& vocabulary);

// A word of no edition, or of a later one. Of a source with an error, in which no more can be asked.
std::string foreignWordIn(const Source& source, int edition, const Vocabulary& vocabulary);
// Empty: all of it is of the edition.
std::string foreignTo(int edition, const Source& source, const Vocabulary& vocabulary);

}  // namespace rung::conformance
