// SPDX-License-Identifier: Apache-2.0
#include "tools/ide/vendor_names.h"

#include <algorithm>

#include "frontend/import/formats.h"
#include "frontend/source/names.h"

namespace rung::ide {
namespace {

// An attribute of an XML element in a text.
struct Attribute {
  std::string_view element;
  uint32_t begin = 0, end = 0;  // of the value
};

// The attributes `name` of the elements before a byte, the last first. Calls `visit` until it says that it is done.
void visitNamesBefore(std::string_view text, uint32_t byte, FunctionRef<bool(const Attribute&)> visit) {
  constexpr std::string_view kName = " Name=\"";
  for (size_t at = text.rfind(kName, byte); at != std::string_view::npos && at > 0; at = text.rfind(kName, at - 1)) {
    const size_t tag = text.rfind('<', at), begin = at + kName.size(), end = text.find('"', begin);
    if (tag == std::string_view::npos || end == std::string_view::npos || text.find('>', tag) < at) continue;
    const std::string_view element = text.substr(tag + 1, text.find_first_of(" \t\r\n", tag) - tag - 1);
    if (visit({element, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)})) return;
  }
}

class TwinCatObject {
 public:
  TwinCatObject(const View& view, FileId file, const NameChange& change)
      : text_(view.textOf(file)), file_(file), change_(change) {}

  // The `Name` of the innermost object around a declaration. True: the object is that of the file.
  bool rename(uint32_t declaration, std::vector<TextEdit>& edits) const {
    bool is_outer = false;
    visitNamesBefore(text_, declaration, [&](const Attribute& attribute) {
      if (!isObject(attribute.element)) return false;
      if (!sameIdentifier(text_.substr(attribute.begin, attribute.end - attribute.begin), change_.from)) return true;
      edits.push_back({{file_, attribute.begin, attribute.end}, change_.to});
      is_outer = isOuter(attribute.element);
      return true;
    });
    return is_outer;
  }

  // <LineIds Name="Motor.Stop">: which lines of the text had breakpoints.
  void renameLineIds(bool is_outer, std::vector<TextEdit>& edits) const {
    visitNamesBefore(text_, static_cast<uint32_t>(text_.size()), [&](const Attribute& attribute) {
      if (attribute.element != "LineIds") return false;
      uint32_t begin = attribute.begin;
      for (bool is_first = true; begin < attribute.end; is_first = false) {
        const auto end = std::min(static_cast<uint32_t>(text_.find_first_of(".\"", begin)), attribute.end);
        if (is_first == is_outer && sameIdentifier(text_.substr(begin, end - begin), change_.from))
          edits.push_back({{file_, begin, end}, change_.to});
        begin = end + 1;
      }
      return false;
    });
  }

 private:
  static bool isOuter(std::string_view element) {
    return element == "POU" || element == "DUT" || element == "Itf" || element == "GVL" || element == "Task";
  }
  static bool isObject(std::string_view element) {
    return isOuter(element) || element == "Method" || element == "Property" || element == "Action" ||
           element == "Transition";
  }

  std::string_view text_;
  FileId file_;
  const NameChange& change_;
};

bool isTwinCat(std::string_view path) {
  const size_t dot = path.rfind('.');
  return dot != std::string_view::npos && path.substr(dot).starts_with(".Tc");
}

}  // namespace

void addVendorNames(const View& view, const std::vector<Reference>& references, const NameChange& change,
                    std::vector<TextEdit>& edits) {
  for (const Reference& reference : references) {
    if (!reference.is_declaration || !isTwinCat(view.pathOf(reference.at.file))) continue;
    const TwinCatObject object(view, reference.at.file, change);
    const bool is_outer = object.rename(reference.at.begin, edits);
    object.renameLineIds(is_outer, edits);
  }
}

std::vector<FileMove> movesFor(const View& view, const std::vector<Reference>& references, const NameChange& change) {
  std::vector<FileMove> moves;
  for (const Reference& reference : references) {
    const std::string path = view.pathOf(reference.at.file);
    if (!reference.is_declaration || !isTwinCat(path)) continue;
    std::vector<TextEdit> edits;
    const bool is_outer = TwinCatObject(view, reference.at.file, change).rename(reference.at.begin, edits);
    const size_t slash = path.rfind('/') + 1, dot = path.rfind('.');
    if (is_outer && sameIdentifier(std::string_view(path).substr(slash, dot - slash), change.from))
      moves.push_back({path, path.substr(0, slash) + change.to + path.substr(dot)});
  }
  return moves;
}

// <Compile Include="POUs\Motor.TcPOU"> in a .plcproj, `sources = Globals.st, lib/` in a rung.project.
void addNamesOfFile(const View& view, const FileMove& move, std::vector<TextEdit>& edits) {
  const auto nameOf = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
  const std::string from = nameOf(move.from), to = nameOf(move.to);
  for (uint32_t i = 1; i <= view.sources().fileCount(); ++i) {
    const FileId file{i};
    const importer::FileRole role = importer::roleOf(importer::kindOfExtension(view.pathOf(file)));
    const bool is_rungs = role == importer::FileRole::RungProject;
    if (!is_rungs && role != importer::FileRole::ListingProject) continue;
    const std::string_view text = view.textOf(file), before = is_rungs ? "= \t,/" : "\\/\"";
    const std::string_view after = is_rungs ? " \t,\r\n" : "\"";
    for (size_t at = text.find(from); at != std::string_view::npos; at = text.find(from, at + 1)) {
      const size_t end = at + from.size();
      const bool is_whole = at > 0 && before.find(text[at - 1]) != std::string_view::npos &&
                            (end == text.size() || after.find(text[end]) != std::string_view::npos);
      if (is_whole) edits.push_back({{file, static_cast<uint32_t>(at), static_cast<uint32_t>(end)}, to});
    }
  }
}

}  // namespace rung::ide
