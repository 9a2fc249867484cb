// SPDX-License-Identifier: Apache-2.0
// A checked project for tests of declarations. In: sources. Out: tables and diagnostics.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frontend/parse/parse.h"
#include "sema/check.h"

namespace rung::sema {

struct Checked {
  Sources sources;
  Names names;
  Diagnostics diagnostics{sources};
  Tree tree;
  Project project;

  explicit Checked(std::string_view text, Options options = {})
      : Checked(std::vector<std::pair<std::string, std::string>>{{"main.st", std::string(text)}}, options) {}
  explicit Checked(const std::vector<std::pair<std::string, std::string>>& files, Options options = {})
      : project(sources, names, diagnostics, tree, options) {
    for (const auto& [path, text] : files) {
      const FileId file = sources.add(path, text);
      text::parseFile(tree, names, sources, file, options.dialect, diagnostics);
    }
    check(project);
    diagnostics.sort();
  }

  // The errors, and the warnings of declarations: "E0301@2 E0402@5".
  std::string codes() const {
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      const std::string_view code = diagInfo(diagnostic.diag).code;
      if (code[0] == 'W' && code.substr(0, 3) != "W03" && code.substr(0, 3) != "W08") continue;
      if (!all.empty()) all += ' ';
      all += code;
      all += '@' + std::to_string(sources.location(diagnostic.loc).line);
    }
    return all;
  }
  std::string messages() const {
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      all += diagnostic.message + '\n';
      for (const auto& note : diagnostic.notes) all += "  " + note.message + '\n';
    }
    return all;
  }
  const Var& var(std::string_view name) const {
    for (const Var& var : project.vars) {
      if (var.name && sameIdentifier(names.string(var.name), name)) return var;
    }
    return project.vars[0];
  }
  const Pou& pou(std::string_view name) const {
    for (const Pou& pou : project.pous) {
      if (pou.unique_name && sameIdentifier(names.string(pou.unique_name), name)) return pou;
    }
    return project.pous[0];
  }
  std::string typeOf(std::string_view name) const { return project.types.toString(var(name).type); }
  std::string valueOf(std::string_view name) const {
    return var(name).has_value ? types::toString(project.types, names, var(name).value) : "none";
  }
};

}  // namespace rung::sema
