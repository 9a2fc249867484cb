// SPDX-License-Identifier: Apache-2.0
// The words of one statement or declaration: IF … THEN … ELSIF … ELSE … END_IF, a loop with its EXIT and CONTINUE. In:
// a view and a byte of a file. Out: the words that belong to the one at the byte. Works on the text, so that a
// statement without its end has its words too.
#pragma once

#include <vector>

#include "tools/ide/view.h"

namespace rung::ide {

// In the order of the text; empty: no such word is there.
std::vector<FileRange> matchingWords(const View& view, FileId file, uint32_t byte);

}  // namespace rung::ide
