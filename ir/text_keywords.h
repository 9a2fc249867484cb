// SPDX-License-Identifier: Apache-2.0
// Shared by the printer and the reader of IR text: the keywords, the letters of elementary types and the check that a
// bare `!` means. Internal to text_printer.cpp and text_parser.cpp.
#pragma once

#include <span>
#include <string_view>

#include "ir/ir.h"

namespace rung::ir::text_form {

struct TypeKeyword {
  const char* word;
  types::TypeKind kind;
};
// bool, byte, …, wchar: the elementary types except strings.
std::span<const TypeKeyword> typeKeywords();
const char* keywordOf(types::TypeKind kind);  // null: not an elementary type

// The access to a part of an integer: `.%X`, `.%B`, `.%W`, `.%D`.
const char* bitsWord(types::TypeKind part);

// The word of a kind of node, from instructions.def; empty: its form has none.
const char* wordOf(ExprKind kind);
const char* wordOf(StmtKind kind);
// The kind of statement that begins with a word; None: no kind does.
StmtKind statementOf(std::string_view word);

// Keywords: a name that equals one needs backticks.
bool isReserved(std::string_view name);

struct CheckKeyword {
  const char* word;
  uint8_t check;
};
std::span<const CheckKeyword> checkKeywords();

// The check that `!` without a list means on this node.
uint8_t naturalCheck(Op op);
uint8_t naturalCheck(const types::TypeTable& types, const Expr& expr);

// The type of an integer literal without prefix where no type is expected; `true` is a BOOL, `0.5` a REAL.
inline constexpr TypeId kDefaultInteger = types::kInt;

}  // namespace rung::ir::text_form
