// SPDX-License-Identifier: Apache-2.0
// CODESYS 2.3 writes in front of each object whether comments nest in it: (* @NESTEDCOMMENTS := 'Yes' *). In: a
// comment. Out: its value. Called by the lexer and by the readers of vendor files.
#pragma once

#include <string_view>

namespace rung {

inline constexpr char kCommentsNest[] = "(* @NESTEDCOMMENTS := 'Yes' *)";
inline constexpr char kCommentsDoNotNest[] = "(* @NESTEDCOMMENTS := 'No' *)";

// The first letter of 'Yes' or 'No' where the comment has the attribute, else null.
inline const char* nestingOf(std::string_view comment) {
  constexpr std::string_view kHead = "(* @NESTEDCOMMENTS := '";
  if (comment.size() <= kHead.size() || comment.substr(0, kHead.size()) != kHead) return nullptr;
  const char* const word = comment.data() + kHead.size();
  return *word == 'Y' || *word == 'N' ? word : nullptr;
}

}  // namespace rung
