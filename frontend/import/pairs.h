// SPDX-License-Identifier: Apache-2.0
// POUs in several files. In two: declaration and body are stored separately, Motor.pou and Motor.st, Motor.decl and
// Motor.impl, Motor_declaration.st and Motor_body.st, Motor/declaration.st and Motor/implementation.st. A member in a
// file of its own: Motor.Start.st, or Start.st in a folder Motor. In: the sources in ST. Out: those that belong
// together, joined to one source. Called by the driver for all files of a project.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"

namespace rung::importer {

// The common part of the paths of the two files: without the extension and the word that distinguishes them.
std::string pairName(std::string_view path);

struct PairCandidate {
  std::string_view path;
  FileId file;  // none afterwards: joined to another one, or an error was reported
};
// When one of two files with equal names begins a POU or method and the other has no declaration, they are the POU and
// its body.
void joinPairs(Sources& sources, std::vector<PairCandidate>& files);
// Puts files that begin with METHOD, PROPERTY or ACTION into the block after which they are named, and files of
// statements as actions. False: a block was not found, which was reported.
bool joinMembers(Sources& sources, std::vector<PairCandidate>& files, Diagnostics& diagnostics);

}  // namespace rung::importer
