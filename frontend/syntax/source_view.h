// SPDX-License-Identifier: Apache-2.0
// The source as the tree divides it: every byte of a file belongs to the innermost node around it, or to the file. In:
// the tree of a file and its source, also with errors. Out: consecutive pieces; those of one node are what its children
// leave over: its keywords, operators and comments. The tree itself keeps no tokens: they are read again on demand.
#pragma once

#include <string>
#include <vector>

#include "frontend/source/files.h"
#include "frontend/syntax/node_at.h"

namespace rung {

struct SourcePiece {
  Range range;
  NodeRef node;  // none: of the file, between declarations
};
std::vector<SourcePiece> piecesOf(const Tree& tree, const FileUnit& unit, const Sources& sources);

// The file, printed from the tree piece by piece, byte for byte.
std::string printSource(const Tree& tree, const FileUnit& unit, const Sources& sources);

// The tokens, comments and pragmas of a node itself, without those of its children: of an IfStmt IF, THEN, ELSE, END_IF
// and `;`. Units as Scanner finds them: an operator of two characters is two.
std::vector<Range> tokensOf(const Tree& tree, const Sources& sources, NodeRef node);

}  // namespace rung
