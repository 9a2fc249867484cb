// POUs in two files, whose declaration and body are stored separately: Motor.pou and Motor.st, Motor.decl and
// Motor.impl, Motor_declaration.st and Motor_body.st, Motor/declaration.st and Motor/implementation.st. In: the sources
// in ST. Out: those that belong together, joined to one source. Called by the driver for all files of a project.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/files.h"

namespace rung::importer {

// The common part of the paths of the two files: without the extension and the word that distinguishes them.
std::string pairName(std::string_view path);

struct PairCandidate {
  std::string_view path;
  FileId file;  // none afterwards: the body of a POU, joined to its declaration
};
// When one of two files with equal names begins a POU and the other has no declaration, they are the POU and its body.
void joinPairs(Sources& sources, std::vector<PairCandidate>& files);

}  // namespace rung::importer
