// SPDX-License-Identifier: Apache-2.0
// See ir_text.h.
#include "ir_text.h"

namespace rung::ir {

TestModule::TestModule(std::string text, std::string path)
    : diagnostics(sources), types(names, 8), module(types, names, sources) {
  FileId file = sources.add(std::move(path), std::move(text));
  ok = parse(sources, file, module, diagnostics);
}

std::string TestModule::errors() const {
  std::string out;
  for (const Diagnostic& d : diagnostics.all()) {
    SourceLocation location = sources.location(d.loc);
    out += std::to_string(location.line) + ":" + std::to_string(location.column) + " " + diagInfo(d.diag).code + " " +
           d.message + "\n";
  }
  return out;
}

Body* TestModule::find(std::string_view name) {
  for (size_t i = 1; i < module.bodies.size(); ++i)
    if (names.string(module.bodies[i].name) == name && module.bodies[i].kind != BodyKind::Init)
      return &module.bodies[i];
  return nullptr;
}

std::string squeeze(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '\n' || c == '\t' || c == '\r') c = ' ';
    if (c == ' ' && (out.empty() || out.back() == ' ')) continue;
    out += c;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace rung::ir
