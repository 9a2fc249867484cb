// SPDX-License-Identifier: Apache-2.0
// Conditional pragmas of the codesys dialect, accepted in all dialects: {define}, {undefine}, {IF}, {ELSIF}, {ELSE},
// {END_IF}. A filter in front of the parser. In: the sources of a project and the defines of the command line. Out:
// sources to parse, in which the pragmas and the code that they exclude are blanks: locations stay valid, messages show
// the original, and no later phase sees a condition. Libraries are not filtered: they are read on first use, later than
// this. Called by the driver before it parses.
#pragma once

#include <span>
#include <string>

#include "frontend/parse/parse.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"

namespace rung::text {

struct Define {
  std::string name, value;
};

// {define} holds from its location to the end of its file. `defined (variable: x)`, `type:`, `pou:`, `task:`,
// `resource:`, `hasattribute` and `hastype` ask about declarations of the project, which are known only when everything
// outside of such conditions has been parsed. Only where such a condition occurs are the files parsed here, an extra
// time. Returns whether there is one: what a file contains may then depend on what others declare.
bool applyConditions(Sources& sources, std::span<const FileId> files, std::span<const Define> defines, Dialect dialect,
                     Diagnostics& diagnostics);

}  // namespace rung::text
