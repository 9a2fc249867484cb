// SPDX-License-Identifier: Apache-2.0
// The formatter of ST, IL, textual SFC and the notation of networks. In: a source, which may be a fragment such as the
// declarations of a POU. Out: the same source with other white space and keywords in one case: every token, comment and
// pragma is kept, and every line break; only lines that are too long are broken further. What is formatted once does
// not change again. Called by `rung fmt`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/dialect.h"

namespace rung::format {

enum class KeywordCase : uint8_t { Upper, Lower, Keep };

// The section [fmt] of rung.project.
struct Style {
  KeywordCase keywords = KeywordCase::Upper;
  bool align = true;         // the types of declarations that follow each other
  uint32_t width = 120;      // longer lines are broken; 0: none is
  uint32_t indent = 2;       // blanks for each level
  uint32_t blank_lines = 1;  // at most, in a row
};

struct Span {
  uint32_t begin, end;  // bytes
};
// The bodies whose lines are instructions, in the order of the source.
struct Bodies {
  std::vector<Span> il;
};

// The lines of the source that may change, from 1.
struct LineRange {
  uint32_t first = 1, last = UINT32_MAX;
};

std::string formatted(std::string_view source, const Bodies& bodies, const Style& style, Dialect dialect,
                      LineRange range = {});

// An NCT program: elements indented by their branches, the columns of its symbols aligned.
std::string formattedLadder(std::string_view source, const Style& style, LineRange range = {});

// The messages of such a program: a tab between number and text.
std::string formattedMessages(std::string_view source, const Style& style, LineRange range = {});

// The parts of a file in which a tool keeps other data as well; all else stays byte for byte.
std::string formattedParts(std::string_view source, const std::vector<Span>& parts, const Bodies& bodies,
                           const Style& style, Dialect dialect);

// The declarations, statements and instructions inside a file of TwinCAT, PLCopen or IEC 61131-10; all else stays byte
// for byte.
std::string formattedXml(std::string_view source, const Style& style, Dialect dialect);

}  // namespace rung::format
