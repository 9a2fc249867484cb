// Programs in the files of other tools: TwinCAT 3, CODESYS 2.3 exports, MULTIPROG and PC Worx, and POUs whose
// declaration and body are files of their own. In: a source file. Out: a text that the ST parser reads, whose locations
// are places of that file; what a POU consists of stands in one order, whatever the order of the file:
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
  None,            // an ordinary text, or XML of another kind
  TwinCat,         // .TcPOU .TcDUT .TcGVL .TcIO .TcTTO
  TwinCatProject,  // .plcproj
  Codesys2,        // .EXP
  Multiprog,       // .ST of MULTIPROG and PC Worx
};

// By content alone.
Format formatOf(std::string_view source);

// The program that `file` holds, as a file of its own; `file` itself where it can be parsed as it stands. No file: an
// error has been reported.
FileId readProgram(Sources& sources, FileId file, Format format, Diagnostics& diagnostics);

// What two files of one POU have in common: their path without extension and without the word that tells them apart.
// Motor.pou and Motor.st, Motor.decl and Motor.impl, Motor_declaration.st and Motor_body.st, Motor/declaration.st and
// Motor/implementation.st.
std::string pairName(std::string_view path);

// A POU from the file of its declaration and the file of its body.
FileId joinPair(Sources& sources, FileId declaration, FileId body);

// What a .plcproj lists, in its order.
struct ProjectEntry {
  std::string name;   // of a file: its path below the project's folder, with `/`; of a library: its title
  std::string space;  // of a library: the namespace under which the project knows it, or empty
  Loc loc;
};
struct Project {
  std::vector<ProjectEntry> files;  // those that hold programs
  std::vector<ProjectEntry> libraries;
};
[[nodiscard]] bool readProject(const Sources& sources, FileId file, Diagnostics& diagnostics, Project& out);

// The first word of an ST text behind blanks, comments and pragmas, in upper case: FUNCTION_BLOCK.
std::string firstWord(std::string_view source);

}  // namespace rung::vendor
