// SPDX-License-Identifier: Apache-2.0
// The inputs of a run: files and folders named on the command line, and the rung.project that a folder may contain.
// In: arguments of the command line. Out: source files with their kind, sorted by path from the project's root, so the
// output does not depend on the order of arguments or directory entries. Mistakes become diagnostics. Called by
// compile.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/import/formats.h"
#include "frontend/source/diagnostics.h"
#include "tools/driver/options.h"
#include "tools/driver/project_file.h"

namespace rung::driver {

using importer::FileKind;
using importer::FileRole;

struct InputFile {
  std::string path;   // to open it
  std::string shown;  // the display path: what the user wrote, for files of a folder with their path below it
  std::string below;  // relative to the root: the path in generated code and the symbol map
  FileKind kind = FileKind::Unknown;
  FileId file;
  bool is_library = false;  // listed by a .plcproj given with -I
  uint32_t library = 0;     // then: its index in Inputs::library_names
};

// A file of a library given with -I that is not in ST.
struct LibraryInput {
  std::string path, library;
  FileKind kind = FileKind::Unknown;
  FileId file;
};

struct Inputs {
  std::string root;                  // absolute
  std::vector<InputFile> files;      // the ones to compile, sorted by `below`
  std::vector<std::string> folders;  // named on the command line
  std::vector<std::string> read;     // every file and folder looked at, for depfiles
  ProjectFile project;
  std::vector<importer::Library> libraries;  // requested by .plcproj and .xml files among them
  std::vector<std::string> project_names;    // of these files: `TcUnit.FB_TestSuite` names a declaration of the project
  std::vector<std::vector<std::string>> library_names;  // of each .plcproj given with -I
  std::vector<LibraryInput> library_files;
  std::vector<InputFile> message_files;     // of the ladder among the files, sorted as these
  std::vector<importer::Message> messages;  // of this ladder
  bool has_ladder = false;                  // a .nct file was read
  bool is_twincat = false;                  // a .plcproj was read
  bool unread = false;                      // a file could not be understood: its declarations are missing
  uint32_t missing_files = 0;               // that a .plcproj lists, and binary files: one error each
  bool io_error = false;                    // something could not be read: exit 2
};

void readInputs(const ProjectOptions& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs);

// Replaces each vendor's file by its program in ST, and the two files of one POU by one source.
void readPrograms(Sources& sources, Diagnostics& diagnostics, Inputs& inputs, bool for_pictures);

}  // namespace rung::driver
