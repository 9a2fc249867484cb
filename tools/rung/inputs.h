// The inputs of a run: files and folders named on the command line, and the rung.project that a folder may hold.
// In: the words of the command line. Out: text files with their kind, sorted by path from the project's root, so that
// no order of words or of directory entries shows in the output. Mistakes become diagnostics. Called by compile.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"
#include "frontend/vendor/vendor.h"
#include "tools/rung/options.h"
#include "tools/rung/project_file.h"

namespace rung::tool {

enum class FileKind : uint8_t {
  Unknown,
  St,
  Il,
  Xml,
  Nct,
  Cam,
  TwinCat,
  PlcProject,
  Plcopen,
  Iec10,
  Codesys2,
  Multiprog,
  Project,
  Binary
};

// By content, then extension. `text` may be cut.
FileKind kindOf(std::string_view path, std::string_view text);

struct InputFile {
  std::string path;   // to open it
  std::string shown;  // as messages name it: what the user wrote, with what stands below a folder behind it
  std::string below;  // relative to the root: what generated code and the symbol map name
  FileKind kind = FileKind::Unknown;
  FileId file;
};

struct Inputs {
  std::string root;               // absolute
  std::vector<InputFile> files;   // the ones to compile, sorted by `below`
  std::vector<std::string> read;  // every file and folder looked at, for depfiles
  ProjectFile project;
  std::vector<vendor::ProjectEntry> libraries;  // that .plcproj and .xml files among them ask for
  std::vector<std::string> project_names;       // of these files: `TcUnit.FB_TestSuite` names what the project declares
  bool unread = false;                          // a vendor's file could not be understood: what it declares is missing
  bool io_error = false;                        // something could not be read: exit 2
};

void readInputs(const Options& options, Sources& sources, Diagnostics& diagnostics, Inputs& inputs);

// Puts the program in place of each vendor's file, and one text in place of the two files of a POU.
void readPrograms(Sources& sources, Diagnostics& diagnostics, Inputs& inputs);

}  // namespace rung::tool
