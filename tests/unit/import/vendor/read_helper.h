// Reads a vendor's file like the tool does.
#pragma once

#include <string>

#include "frontend/import/vendor.h"

namespace rung::vendor {

struct Reading {
  explicit Reading(const std::string& path, std::string text) {
    file = sources.add(path, std::move(text));
    program = readProgram(sources, file, formatOf(sources.sourceText(file)), diagnostics);
  }
  std::string text() const { return program ? std::string(sources.sourceText(program)) : "none"; }
  // "line:column" in the vendor's file for the first position where the program has `what`.
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
  FileId file, program;
};

}  // namespace rung::vendor
