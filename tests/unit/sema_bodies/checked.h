// SPDX-License-Identifier: Apache-2.0
// Checks a program for a test, with a small library. In: the source. Out: diagnostics as `line:column code`, and the
// checked tree in a text form with implicit conversions, types of literals and resolved calls.
#pragma once

#include <string>

#include "frontend/source/dialect.h"
#include "sema/check.h"

namespace rung::sema_test {

struct Checked {
  explicit Checked(const std::string& source, Dialect dialect = Dialect::Codesys);
  // All diagnostics, one a line: `4:7 E0501`. Empty: none.
  std::string codes() const;
  // The same with their messages.
  std::string messages() const;
  // The statements of a POU: `x := REAL(i) + REAL#1;` — conversions as TYPE(…), literals as TYPE#value.
  std::string body(const std::string& pou) const;

  Sources sources;
  Names names;
  Tree tree;
  Diagnostics diagnostics{sources};
  sema::Project project;
};

// The diagnostics of statements in a program with these variables; lines count from the first statement, 1.
std::string codesOf(const std::string& vars, const std::string& statements, Dialect dialect = Dialect::Codesys);
// The statements in the tree after the check; diagnostics instead when there are errors.
std::string treeOf(const std::string& vars, const std::string& statements, Dialect dialect = Dialect::Codesys);

}  // namespace rung::sema_test
