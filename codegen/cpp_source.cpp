// SPDX-License-Identifier: Apache-2.0
// Splits the source of a body in C++: see cpp_source.h.
#include "codegen/cpp_source.h"

#include <algorithm>
#include <vector>

#include "codegen/names.h"

namespace rung::codegen {
namespace {

// A preprocessor directive, `include`; empty: not a directive.
std::string_view directiveOf(std::string_view row) {
  const auto skipBlanks = [&] { row.remove_prefix(std::min(row.find_first_not_of(" \t"), row.size())); };
  skipBlanks();
  if (!row.starts_with('#')) return {};
  row.remove_prefix(1);
  skipBlanks();
  return row.substr(0, std::min(row.find_first_of(" \t\r<\"(!"), row.size()));
}

bool isCondition(std::string_view directive) {
  return directive.starts_with("if") || directive.starts_with("el") || directive == "endif";
}

std::vector<std::string_view> rowsOf(std::string_view source) {
  std::vector<std::string_view> rows;
  for (size_t at = 0; at <= source.size();) {
    const size_t end = std::min(source.find('\n', at), source.size());
    rows.push_back(source.substr(at, end - at));
    at = end + 1;
  }
  return rows;
}

bool hasNestedInclude(const std::vector<std::string_view>& rows) {
  uint32_t depth = 0;
  for (const std::string_view row : rows) {
    const std::string_view directive = directiveOf(row);
    if (directive.starts_with("if")) ++depth;
    if (directive == "endif" && depth > 0) --depth;
    if (directive == "include" && depth > 0) return true;
  }
  return false;
}

void appendLineDirective(std::string& to, uint32_t line, std::string_view path) {
  to += "#line ";
  appendUnsigned(to, line);
  to += ' ';
  appendQuoted(to, path);
  to += '\n';
}

}  // namespace

void splitCppSource(std::string_view source, std::string_view path, const SourceLocation& location, std::string& code,
                    std::string& front) {
  if (source.empty()) return;
  const std::vector<std::string_view> rows = rowsOf(source);
  const bool is_nested = hasNestedInclude(rows);
  appendLineDirective(code, location.line, path);
  code.append(location.column - 1, ' ');
  bool continues = false, moves = false, copies = false;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) code += '\n';
    if (!continues) {
      const std::string_view directive = directiveOf(rows[i]);
      moves = directive == "include";
      copies = is_nested && isCondition(directive);
    }
    if (moves || copies) {
      if (!continues) appendLineDirective(front, location.line + static_cast<uint32_t>(i), path);
      front += std::string(rows[i]) + '\n';
    }
    if (!moves) code += rows[i];
    continues = (moves || copies) && rows[i].ends_with('\\');
  }
}

}  // namespace rung::codegen
