// SPDX-License-Identifier: Apache-2.0
// Changes of a text, collected in any order and then made at once. In: byte ranges and what replaces them. Out: the
// text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rung::conformance {

struct Edit {
  size_t begin, end;
  std::string text;
};

// The part [from, to) with the edits that begin in it. Of two edits of one place the longer one wins; insertions come
// first.
std::string rendered(std::string_view text, size_t from, size_t to, std::vector<Edit> edits);

// As many line ends as the part [from, to) has, so that what follows stays on its line.
std::string lineEndsOf(std::string_view text, size_t from, size_t to);

}  // namespace rung::conformance
