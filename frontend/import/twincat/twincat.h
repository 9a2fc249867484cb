// SPDX-License-Identifier: Apache-2.0
// TwinCAT 3: the files of POUs and types (.TcPOU, …) and the project that lists them (.plcproj), rows of the table of
// formats. The parts of a POU are always in this order, regardless of their order in the file:
//
//   declaration, {METHOD … END_METHOD | PROPERTY … END_PROPERTY | ACTION name : … END_ACTION}, body, END_…
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/formats.h"

namespace rung::importer::twincat {

bool isTwinCat(std::string_view text);  // by content alone
bool isProject(std::string_view text);

FileId readProgram(ReadContext& context, FileId file);

struct ProjectEntry {
  std::string path;  // below the project's folder, with `/`
  Loc loc;
};
struct Project {
  std::vector<ProjectEntry> files;  // those that contain programs, in the order of the project
  std::vector<Library> libraries;
  std::vector<std::string> names;  // title, name and namespace, as other projects refer to it
};
[[nodiscard]] bool readProject(const Sources& sources, FileId file, Diagnostics& diagnostics, Project& out);

}  // namespace rung::importer::twincat
