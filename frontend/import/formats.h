// SPDX-License-Identifier: Apache-2.0
// The table of file formats: how the kind of a file is recognised, and how its program is read. In: the path and text
// of a file. Out: its kind; its program as source-mapped text (frontend/import/source_mapped_text.h) that the parser
// reads, with locations in that file. A new format is a row of formats.cpp, which also answers what the driver, `rung
// fmt` and `rung convert` ask of a file. Called by the driver for each input file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/source/diagnostics.h"

namespace rung::importer {

enum class FileKind : uint8_t {
  Unknown,
  St,
  Il,
  Xml,             // of an unknown kind
  Nct,             // machine-tool ladder
  Messages,        // texts of its messages
  Cam,             // cam tables
  TwinCat,         // .TcPOU .TcDUT .TcGVL .TcIO .TcTTO
  PlcProject,      // .plcproj of TwinCAT
  Plcopen,         // TC6 XML
  Iec10,           // XML of IEC 61131-10
  BeremizProject,  // beremiz.xml: its folder is a project of Beremiz or OpenPLC
  Beremiz,         // extensions of such projects
  Codesys2,        // exports of CODESYS 2.3
  Multiprog,       // MULTIPROG and PC Worx
  Project,         // rung.project
  Binary
};

// A library to which a project of another tool refers.
struct Library {
  std::string name;   // its title
  std::string space;  // its namespace in the project, or empty
  Loc loc;
};

// The settings of an NCT control: the periods of Main and Int0, and where user memory begins.
struct LadderSettings {
  int64_t plc_period_ns = 10'000'000, time_slice_ns = 2'000'000;
  uint32_t kept = 4000, volatile_ = 5024;  // PLCNVRAM, PLCRAM
};

// Of a ladder.
struct Message {
  uint32_t number;
  std::string text;
};

struct ReadContext {
  Sources& sources;
  Diagnostics& diagnostics;
  std::vector<Library>& libraries;  // those that the files ask for are added
  LadderSettings ladder = {};
  bool for_pictures = false;               // `rung graph` draws what is read: a ladder becomes networks, not statements
  std::vector<FileId> message_files = {};  // with texts of the ladder
  std::vector<Message> messages = {};      // of the ladder that has been read, those of the files among them
  std::vector<std::string> task_configurations = {};  // of CODESYS 2.3, without blanks: those that have been read
};

// Bytes of a file in which a tool keeps programs and other data.
struct TextPart {
  uint32_t begin, end;
};

// What a file is for.
enum class FileRole : uint8_t {
  Program,        // source, if something reads it
  Messages,       // texts that a ladder shows
  RungProject,    // rung.project
  FolderProject,  // its folder is a project of another tool
  ListingProject  // it lists the files of a project of another tool
};

enum : uint8_t {
  kHoldsProject = 1,  // a tool keeps a whole project in such a file: `rung convert` makes a folder of it
  kHasHalves = 2,     // it may be one of two files that belong together (pairs.h)
  kHasControl = 4     // its programs need the memory and the messages of an NCT control
};

// How `rung fmt` formats it.
enum class Formatting : uint8_t { None, Text, Ladder, Messages, Xml, Parts };

struct Format {
  FileKind kind;
  FileRole role;
  Formatting formatting;
  std::string_view name;                  // in messages, for kinds that are not read
  std::string_view extensions;            // separated by blanks; those of several rows belong to the first
  bool (*detect)(std::string_view text);  // by content; null: by extension only
  // The program in the file, as a separate file; the file itself if it can be parsed unchanged. No file: an error has
  // been reported. Null: the parser reads it unchanged, or nothing reads it.
  FileId (*read)(ReadContext& context, FileId file);
  // The declarations and bodies in it, for the formatter; reports what `read` reports. Null: all of the text, or
  // nothing.
  std::vector<TextPart> (*parts)(Sources& sources, FileId file, Diagnostics& diagnostics) = nullptr;
  uint8_t traits = 0;
  bool has(uint8_t trait) const { return (traits & trait) != 0; }
};

const Format& formatOf(FileKind kind);
inline FileRole roleOf(FileKind kind) { return formatOf(kind).role; }

// By content, then extension. `text` may be only the beginning.
FileKind kindOf(std::string_view path, std::string_view text);
FileKind kindOfExtension(std::string_view path);

// Tells whether sources of this kind end in the parser.
bool holdsProgram(FileKind kind);

// Tells whether a file of this kind says which other files belong to a program.
bool isProject(FileKind kind);

bool hasExtension(std::string_view path, std::string_view extension);  // in lower case, with its dot

// The beginning of a file is not source in any encoding that editors of PLC code write.
bool isBinary(std::string_view text);

}  // namespace rung::importer
