// Conditional pragmas of codesys, in all dialects: {define}, {undefine}, {IF}, {ELSIF}, {ELSE}, {END_IF}.
// In: the texts of a project and the defines of the command line. Out: texts to parse, in which what a condition
// excludes, and the pragmas themselves, are blanks: places stay true, and no later phase knows of conditions.
// Called by the driver before it parses.
#pragma once

#include <span>
#include <string>

#include "frontend/source/diagnostics.h"
#include "frontend/source/dialect.h"
#include "frontend/text/parse.h"

namespace rung::text {

struct Define {
  std::string name, value;
};

// {define} holds from its place to the end of its file. `defined (variable: x)`, `type:`, `pou:`, `task:`,
// `resource:`, `hasattribute` and `hastype` ask for declarations of the project, which are known once everything
// outside of such conditions has been parsed: then, and only then, the files are parsed here once more.
void applyConditions(Sources& sources, std::span<const FileId> files, std::span<const Define> defines, Dialect dialect,
                     Diagnostics& diagnostics);

}  // namespace rung::text
