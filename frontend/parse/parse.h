// SPDX-License-Identifier: Apache-2.0
// The parser of Structured Text files. In: one source. Out: its declarations in the tree, and diagnostics.
// One mistake gives one error: after it the parser resumes at the next statement, section or POU (recovery in
// recover.cpp). Called by the driver for each file and by sema for library declarations on first use.
#pragma once

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/syntax/tree.h"

namespace rung {
class Trivia;
}

namespace rung::text {

// Tells whether a word is a keyword in every dialect, so that nothing can have it as its name.
bool isReservedWord(std::string_view word);

// Parses a whole file and appends it to tree.files. With `comments` it keeps the comments of the file there.
FileUnit parseFile(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                   Diagnostics& diagnostics, Trivia* comments = nullptr);

// Parses the one declaration (POU or TYPE entry block) in [begin, end) of its file: a library declaration on first use,
// or a fresh copy of a generic function. Not appended to tree.files.
Slice<DeclId> parseDeclarations(Tree& tree, Names& names, const Sources& sources, Loc begin, Loc end, Dialect dialect,
                                Diagnostics& diagnostics);

// Parses `a := 1, b := [2, 3]` in [begin, end) of its file, the content of a {case …}.
Slice<FieldInit> parseFieldInits(Tree& tree, Names& names, const Sources& sources, Loc begin, Loc end, Dialect dialect,
                                 Diagnostics& diagnostics);

// Parses `text` of `file` as a single expression (for --set, --stop-on and --inputs cells); none when it is not one.
ExprId parseExpression(Tree& tree, Names& names, const Sources& sources, FileId file, Dialect dialect,
                       Diagnostics& diagnostics);

}  // namespace rung::text
