// Block repair: makes the blocks of a token array balance before the parser sees it. A missing, misspelled, surplus or
// wrong END_…, a misspelled or missing opening word and `ELSE IF` are told by comparing the words that open and close
// blocks, and, only where those do not balance, by the indentation; so the layout of a correct program never matters.
// In: the tokens of a file. Out: tokens with words inserted, removed or respelled, and one error per mistake.
// Called by Parser::read.
#pragma once

#include <span>

#include "frontend/source/dialect.h"
#include "frontend/text/lexer.h"

namespace rung::text {

void balanceBlocks(TokenStream& stream, const Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics);

// The keyword among `candidates` nearest to `written`, or End.
Tok nearestKeyword(std::string_view written, std::span<const Tok> candidates);

}  // namespace rung::text
