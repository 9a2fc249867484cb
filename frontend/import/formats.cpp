// SPDX-License-Identifier: Apache-2.0
#include "frontend/import/formats.h"

#include <algorithm>
#include <iterator>

#include "frontend/import/beremiz/beremiz.h"
#include "frontend/import/cam/cam_file.h"
#include "frontend/import/codesys2/codesys2.h"
#include "frontend/import/iec10/iec10.h"
#include "frontend/import/multiprog/multiprog.h"
#include "frontend/import/nct/nct.h"
#include "frontend/import/plcopen/plcopen.h"
#include "frontend/import/twincat/twincat.h"
#include "frontend/import/xml.h"
#include "frontend/source/scanner.h"
#include "frontend/source/text.h"

namespace rung::importer {
namespace {

std::string_view withoutBlanks(std::string_view text) {
  text = withoutMark(text);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

bool isXml(std::string_view text) { return withoutBlanks(text).starts_with("<"); }

// Rows with the same content are in the order in which they are tried.
constexpr Format kFormats[] = {
    {FileKind::TwinCat, FileRole::Program, Formatting::Xml, "", ".tcpou .tcdut .tcgvl .tcio .tctleo .tctto",
     twincat::isTwinCat, twincat::readProgram},
    {FileKind::PlcProject, FileRole::ListingProject, Formatting::None, "", ".plcproj", twincat::isProject, nullptr},
    {FileKind::Multiprog, FileRole::Program, Formatting::Parts, "", "", multiprog::isMultiprog, multiprog::readProgram,
     multiprog::programParts, kHoldsProject},
    {FileKind::Codesys2, FileRole::Program, Formatting::Parts, "", ".exp", codesys2::isCodesys2, codesys2::readProgram,
     codesys2::programParts, kHoldsProject},
    {FileKind::Plcopen, FileRole::Program, Formatting::Xml, "", "", plcopen::isPlcopen, plcopen::readProgram, nullptr,
     kHoldsProject},
    {FileKind::Iec10, FileRole::Program, Formatting::Xml, "", "", iec10::isIec10, iec10::readProgram, nullptr,
     kHoldsProject},
    {FileKind::BeremizProject, FileRole::FolderProject, Formatting::None, "", "", beremiz::isProject, nullptr},
    {FileKind::Beremiz, FileRole::Program, Formatting::None, "", "", beremiz::isExtension, beremiz::readProgram},
    {FileKind::Xml, FileRole::Program, Formatting::None, "XML other than PLCopen's or that of IEC 61131-10",
     ".xml .cfc", isXml, nullptr},
    {FileKind::St, FileRole::Program, Formatting::Text, "", ".st .iecst .pou .decl .impl", nullptr, nullptr, nullptr,
     kHasHalves},
    {FileKind::Il, FileRole::Program, Formatting::Text, "", ".il", nullptr, nullptr},
    {FileKind::Nct, FileRole::Program, Formatting::Ladder, "", ".nct", nullptr, nct::readProgram, nullptr, kHasControl},
    {FileKind::Messages, FileRole::Messages, Formatting::Messages, "", ".mes", nullptr, nullptr},
    {FileKind::Cam, FileRole::Program, Formatting::None, "", ".cam", nullptr, cams::readProgram},
    {FileKind::Project, FileRole::RungProject, Formatting::None, "", "", nullptr, nullptr},
};

bool hasOneOf(std::string_view path, std::string_view extensions) {
  while (!extensions.empty()) {
    const std::string_view extension = extensions.substr(0, extensions.find(' '));
    if (hasExtension(path, extension)) return true;
    extensions.remove_prefix(std::min(extension.size() + 1, extensions.size()));
  }
  return false;
}

}  // namespace

const Format& formatOf(FileKind kind) {
  static constexpr Format kOther = {
      FileKind::Unknown, FileRole::Program, Formatting::None, "a file of another kind", "", nullptr, nullptr};
  for (const Format& row : kFormats)
    if (row.kind == kind) return row;
  return kOther;
}

bool hasExtension(std::string_view path, std::string_view extension) {
  if (path.size() <= extension.size()) return false;
  const std::string_view end = path.substr(path.size() - extension.size());
  return std::equal(end.begin(), end.end(), extension.begin(), [](char a, char b) { return foldedCharacter(a) == b; });
}

FileKind kindOfExtension(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  if (name == "rung.project") return FileKind::Project;
  if (name == "beremiz.xml") return FileKind::BeremizProject;
  for (const Format& row : kFormats)
    if (hasOneOf(path, row.extensions)) return row.kind;
  return FileKind::Unknown;
}

// True for a NUL, and when a fifth of the first bytes is control characters or not UTF-8, unless there is no control
// character at all: a text in an 8-bit code of Windows, which can be mostly letters beyond ASCII.
bool isBinary(std::string_view text) {
  std::string_view head = text.substr(0, 4096);
  if (head.find('\0') != std::string_view::npos) return true;
  size_t bad = 0, controls = 0;
  for (size_t i = 0; i < head.size(); i++) {
    unsigned char c = static_cast<unsigned char>(head[i]);
    if (c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v' && c != 0x1a) controls++;
    if (c < 0x80) continue;
    size_t follow = c >= 0xf0 ? 3 : c >= 0xe0 ? 2 : c >= 0xc0 ? 1 : 0;
    size_t continued = 0;
    while (continued < follow && i + continued + 1 < head.size() && (head[i + continued + 1] & 0xc0) == 0x80)
      continued++;
    if (follow == 0 || continued < follow) bad++;
    i += continued;
  }
  return controls > 0 && (bad + controls) * 5 > head.size();
}

FileKind kindOf(std::string_view path, std::string_view text) {
  if (isBinary(text)) return FileKind::Binary;
  const FileKind by_name = kindOfExtension(path);
  for (const Format& row : kFormats) {
    const bool unknown_xml = row.kind == FileKind::Xml && by_name == FileKind::St;
    if (row.detect != nullptr && row.detect(text) && !unknown_xml) return row.kind;
  }
  if (by_name == FileKind::Unknown && startsDeclaration(text)) return FileKind::St;
  // The extension claims XML, the content is not.
  if (by_name == FileKind::Xml || by_name == FileKind::TwinCat || by_name == FileKind::PlcProject ||
      by_name == FileKind::BeremizProject)
    return FileKind::Unknown;
  return by_name;
}

bool isProject(FileKind kind) { return roleOf(kind) != FileRole::Program && roleOf(kind) != FileRole::Messages; }

bool holdsProgram(FileKind kind) {
  return kind == FileKind::St || kind == FileKind::Il || formatOf(kind).read != nullptr;
}

}  // namespace rung::importer
