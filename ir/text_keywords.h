// What the printer and the reader of IR text must agree on: the reserved words, the letters of elementary types and
// which check a bare `!` stands for. Internal to text_printer.cpp and text_parser.cpp.
#pragma once

#include <span>
#include <string_view>

#include "ir/ir.h"

namespace rung::ir::text_form {

struct TypeKeyword {
  const char* word;
  types::TypeKind kind;
};
// bool, byte, …, wchar: the elementary types without texts.
std::span<const TypeKeyword> typeKeywords();
const char* keywordOf(types::TypeKind kind);  // null: no elementary type

// The access to a part of an integer: `.%X`, `.%B`, `.%W`, `.%D`.
const char* bitsWord(types::TypeKind part);

// Words that a name may not be without backticks.
bool isReserved(std::string_view name);

struct CheckKeyword {
  const char* word;
  uint8_t check;
};
std::span<const CheckKeyword> checkKeywords();

// The check that `!` without a list means on this node.
uint8_t naturalCheck(const types::TypeTable& types, const Expr& expr);

// The type that a literal without prefix has where nothing else is expected: INT, BOOL or REAL.
inline constexpr TypeId kDefaultInteger = types::kInt;

}  // namespace rung::ir::text_form
