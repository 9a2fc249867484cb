// SPDX-License-Identifier: Apache-2.0
// The report of a failed assertion, for both engines. In: an Assert statement. Out: the strings of rung_assertion and
// how its values are formatted. Called by the interpreter's translation and by codegen.
#pragma once

#include <string>
#include <string_view>

#include "ir/description.h"
#include "ir/ir.h"

namespace rung::ir {

struct AssertionReport {
  FilePosition position;
  std::string_view source, message, shown;
  std::string items;  // NULs inside; the last is the string's own
};
AssertionReport assertionReport(const Module& module, const Body& body, const Stmt& stmt);

// The kind of a scalar or string that an assertion compares: hostKind, or RUNG_ENUM, RUNG_STRING, RUNG_WSTRING.
rung_type_kind assertedKind(const types::TypeTable& types, TypeId type);

}  // namespace rung::ir
