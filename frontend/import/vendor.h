// Programs in the files of other tools: TwinCAT 3, CODESYS 2.3 exports, MULTIPROG and PC Worx, and POUs whose
// declaration and body are separate files. In: a source file. Out: source-mapped text
// (frontend/import/source_mapped_text.h) that the ST parser reads, with locations in that file. The parts of a POU are
// always in this order, regardless of their order in the file:
//
//   declaration, {METHOD … END_METHOD | PROPERTY … END_PROPERTY | ACTION name : … END_ACTION}, body, END_…
//
// Called by the tool for each input file of such a format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"

namespace rung::vendor {

enum class Format : uint8_t {
  None,            // plain source, or another kind of XML
  TwinCat,         // .TcPOU .TcDUT .TcGVL .TcIO .TcTTO
  TwinCatProject,  // .plcproj
  Codesys2,        // .EXP
  Multiprog,       // .ST of MULTIPROG and PC Worx
};

// By content alone.
Format formatOf(std::string_view source);

// The program in `file`, as a separate file; `file` itself if it can be parsed unchanged. No file: an error has been
// reported.
FileId readProgram(Sources& sources, FileId file, Format format, Diagnostics& diagnostics);

// The common part of the paths of two files of one POU: without the extension and the word that distinguishes them.
// Motor.pou and Motor.st, Motor.decl and Motor.impl, Motor_declaration.st and Motor_body.st, Motor/declaration.st and
// Motor/implementation.st.
std::string pairName(std::string_view path);

// Joins a POU from the file of its declaration and the file of its body.
FileId joinPair(Sources& sources, FileId declaration, FileId body);

// An entry of a .plcproj, in file order.
struct ProjectEntry {
  std::string name;   // of a file: its path below the project's folder, with `/`; of a library: its title
  std::string space;  // of a library: its namespace in the project, or empty
  Loc loc;
};
struct Project {
  std::vector<ProjectEntry> files;  // those that contain programs
  std::vector<ProjectEntry> libraries;
};
[[nodiscard]] bool readProject(const Sources& sources, FileId file, Diagnostics& diagnostics, Project& out);

// The first word of an ST source after blanks, comments and pragmas, in upper case: FUNCTION_BLOCK.
std::string firstWord(std::string_view source);

}  // namespace rung::vendor
