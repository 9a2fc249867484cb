// What the report of an assertion shows, for both engines. In: an Assert statement. Out: the texts of rung_assertion
// and how its values are spelled. Called by the interpreter's translation and by codegen.
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

// The kind of a scalar or text that an assertion compares: hostKind, but RUNG_ENUM, RUNG_STRING and RUNG_WSTRING.
rung_type_kind assertedKind(const types::TypeTable& types, TypeId type);

}  // namespace rung::ir
