// SPDX-License-Identifier: Apache-2.0
// .plcproj: the project file of TwinCAT 3, in the form of MSBuild. See twincat.h.
#include <algorithm>
#include <string>

#include "frontend/import/twincat/twincat.h"
#include "frontend/import/xml.h"
#include "frontend/source/names.h"

namespace rung::importer::twincat {
namespace {

// MSBuild writes `%28` for a bracket, and `\` between folders.
std::string pathOf(std::string_view text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
      out += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
      i += 2;
    } else {
      out += text[i] == '\\' ? '/' : text[i];
    }
  }
  return out;
}

bool listsProgram(std::string_view path) {
  const size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return false;
  for (const std::string_view extension : {"TcPOU", "TcDUT", "TcGVL", "TcIO", "TcTTO", "TcTLEO"})
    if (sameIdentifier(path.substr(dot + 1), extension)) return true;
  return false;
}

}  // namespace

bool isProject(std::string_view text) {
  return xml::rootName(xml::rootTag(text)) == "Project" &&
         text.find("schemas.microsoft.com/developer/msbuild") != std::string_view::npos;
}

bool readProject(const Sources& sources, FileId file, Diagnostics& diagnostics, Project& out) {
  xml::Document document;
  if (!xml::read(sources, file, diagnostics, document)) return false;
  for (const xml::Element& element : document.elements) {
    const bool names = element.name == "Title" || element.name == "Name" || element.name == "DefaultNamespace";
    if (names && element.parent != xml::kNone && document.elements[element.parent].name == "PropertyGroup")
      if (std::string name = document.text(element, sources); !name.empty()) out.names.push_back(std::move(name));
    const xml::Attribute* include = document.attribute(element, "Include");
    if (include == nullptr) continue;
    const std::string name = document.value(element, "Include");
    if (element.name == "Compile") {
      const xml::Element* excluded = document.child(element, "ExcludeFromBuild");
      if (excluded != nullptr && sameIdentifier(document.text(*excluded, sources), "true")) continue;
      std::string path = pathOf(name);
      if (listsProgram(path)) out.files.push_back({std::move(path), include->loc});
    } else if (element.name == "PlaceholderReference" || element.name == "LibraryReference") {
      // "Standard, 3.5.2.0, System"
      std::string title = name.substr(0, name.find(','));
      while (!title.empty() && (title.back() == ' ' || title.back() == '\t')) title.pop_back();
      const bool seen = std::any_of(out.libraries.begin(), out.libraries.end(),
                                    [&](const Library& library) { return sameIdentifier(library.name, title); });
      const xml::Element* space = document.child(element, "Namespace");
      if (!title.empty() && !seen)
        out.libraries.push_back(
            {std::move(title), space == nullptr ? "" : document.text(*space, sources), include->loc});
    }
  }
  return true;
}

}  // namespace rung::importer::twincat
