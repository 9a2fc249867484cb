// SPDX-License-Identifier: Apache-2.0
// A module read from IR text, together with everything that it refers to. For the tests of ir/.
#pragma once

#include <memory>
#include <string>

#include "ir/text.h"

namespace rung::ir {

struct TestModule {
  explicit TestModule(std::string text, std::string path = "test.ir");
  Sources sources;
  Names names;
  Diagnostics diagnostics;
  types::TypeTable types;
  Module module;
  bool ok;

  std::string errors() const;         // one line each: line:column code message
  Body* find(std::string_view name);  // function or block
};

// Folds blanks and line ends to one blank, for comparing printed bodies.
std::string squeeze(std::string_view text);

}  // namespace rung::ir
