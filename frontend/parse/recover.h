// SPDX-License-Identifier: Apache-2.0
// Block repair: makes the blocks of a token array balance before the parser sees it. Finds a missing, misspelled,
// surplus or wrong END_…, a misspelled or missing opening keyword and `ELSE IF` by comparing the keywords that open and
// close blocks and, only where those do not balance, by the indentation; so the layout of a correct program never
// matters. In: the tokens of a file. Out: tokens with keywords inserted, removed or corrected, and one error per
// mistake. Called by Parser::read.
#pragma once

#include <span>

#include "frontend/parse/lexer.h"
#include "frontend/source/dialect.h"

namespace rung::text {

void balanceBlocks(TokenStream& stream, const Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics);

// The keyword among `candidates` nearest to `written`, or End.
Tok nearestKeyword(std::string_view written, std::span<const Tok> candidates);

}  // namespace rung::text
