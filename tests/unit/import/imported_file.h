// SPDX-License-Identifier: Apache-2.0
// Reads a file of another tool as the driver does.
#pragma once

#include <string>
#include <vector>

#include "frontend/import/formats.h"

namespace rung::importer {

struct ImportedFile {
  ImportedFile(const std::string& path, std::string text) : ImportedFile(path, text, kindOf(path, text)) {}
  ImportedFile(const std::string& path, std::string text, FileKind kind) {
    file = sources.add(path, std::move(text));
    ReadContext context{sources, diagnostics, libraries};
    const Format& format = formatOf(kind);
    program = format.read == nullptr ? file : format.read(context, file);
  }
  std::string text() const { return program ? std::string(sources.sourceText(program)) : "none"; }
  // "line:column" in the file for the first position where the program has `what`.
  std::string locationOf(std::string_view what) const {
    const size_t at = sources.sourceText(program).find(what);
    if (at == std::string_view::npos) return "none";
    return location({sources.begin(program).offset + static_cast<uint32_t>(at)});
  }
  std::string location(Loc loc) const {
    const SourceLocation p = sources.location(loc);
    return std::to_string(p.line) + ":" + std::to_string(p.column);
  }
  // "line:column message" lines.
  std::string errors() const {
    std::string out;
    for (const Diagnostic& d : diagnostics.all()) out += location(d.loc) + " " + d.message + "\n";
    return out;
  }

  Sources sources;
  Diagnostics diagnostics{sources};
  std::vector<Library> libraries;
  FileId file, program;
};

}  // namespace rung::importer
