// A PLCopen project read as the tool reads it.
#pragma once

#include <string>
#include <vector>

#include "frontend/plcopen/plcopen.h"

namespace rung::plcopen {

struct Reading {
  explicit Reading(std::string text) {
    file = sources.add("p.xml", std::move(text));
    program = readProject(sources, file, diagnostics, libraries);
  }
  std::string text() const { return program ? std::string(sources.text(program)) : "none"; }
  // "line:column" in the XML of the first place where the text has `what`.
  std::string placeOf(std::string_view what) const {
    const size_t at = sources.text(program).find(what);
    if (at == std::string_view::npos) return "none";
    return place({sources.begin(program).offset + static_cast<uint32_t>(at)});
  }
  std::string place(Loc loc) const {
    const Place p = sources.place(loc);
    return std::to_string(p.line) + ":" + std::to_string(p.column);
  }
  // "line:column message" lines.
  std::string errors() const {
    std::string out;
    for (const Diagnostic& d : diagnostics.all()) out += place(d.loc) + " " + d.message + "\n";
    return out;
  }

  Sources sources;
  Diagnostics diagnostics{sources};
  std::vector<Library> libraries;
  FileId file, program;
};

}  // namespace rung::plcopen
