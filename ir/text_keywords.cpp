// SPDX-License-Identifier: Apache-2.0
// The keywords of IR text: see text_keywords.h.
#include "ir/text_keywords.h"

namespace rung::ir::text_form {

using types::TypeKind;
using types::TypeTable;

namespace {
constexpr TypeKeyword kTypeKeywords[] = {
    {"bool", TypeKind::Bool},   {"byte", TypeKind::Byte},     {"word", TypeKind::Word},
    {"dword", TypeKind::DWord}, {"lword", TypeKind::LWord},   {"sint", TypeKind::SInt},
    {"int", TypeKind::Int},     {"dint", TypeKind::DInt},     {"lint", TypeKind::LInt},
    {"usint", TypeKind::USInt}, {"uint", TypeKind::UInt},     {"udint", TypeKind::UDInt},
    {"ulint", TypeKind::ULInt}, {"real", TypeKind::Real},     {"lreal", TypeKind::LReal},
    {"time", TypeKind::Time},   {"ltime", TypeKind::LTime},   {"date", TypeKind::Date},
    {"ldate", TypeKind::LDate}, {"tod", TypeKind::TimeOfDay}, {"ltod", TypeKind::LTimeOfDay},
    {"dt", TypeKind::DateTime}, {"ldt", TypeKind::LDateTime}, {"char", TypeKind::Char},
    {"wchar", TypeKind::WChar}, {"uchar", TypeKind::UChar},
};
// Beside the words of instructions.def.
constexpr const char* kReserved[] = {
    "array",      "assert_eq",   "assert_near", "base",         "by",     "case",   "catch", "class",
    "constant",   "else",        "false",       "finally",      "in",     "inf",    "init",  "inout",
    "message",    "nan",         "next",        "non_retain",   "null",   "of",     "on",    "out",
    "persistent", "pointer",     "ref",         "reference",    "result", "retain", "round", "shows",
    "string",     "symbol_none", "symbol_read", "symbol_write", "temp",   "text",   "to",    "true",
    "ustring",    "value",       "var",         "wstring"};
constexpr const char* kExprWords[] = {
#define RUNG_EXPR(kind, word, role, checks, fields) word,
#include "ir/instructions.def"
};
constexpr const char* kStmtWords[] = {
#define RUNG_STMT(kind, word, effect, flow, fields) word,
#include "ir/instructions.def"
};
constexpr CheckKeyword kCheckKeywords[] = {
    {"div", kCheckDiv},           {"index", kCheckIndex},     {"null", kCheckNull},        {"cast", kCheckCast},
    {"subrange", kCheckSubrange}, {"convert", kCheckConvert}, {"overflow", kCheckOverflow}};
}  // namespace

std::span<const TypeKeyword> typeKeywords() { return kTypeKeywords; }
std::span<const CheckKeyword> checkKeywords() { return kCheckKeywords; }

const char* keywordOf(TypeKind kind) {
  for (const TypeKeyword& row : kTypeKeywords)
    if (row.kind == kind) return row.word;
  return nullptr;
}

const char* bitsWord(TypeKind part) {
  if (part == TypeKind::Byte) return ".%B";
  if (part == TypeKind::Word) return ".%W";
  if (part == TypeKind::DWord) return ".%D";
  return ".%X";
}

const char* wordOf(ExprKind kind) { return kExprWords[static_cast<size_t>(kind)]; }
const char* wordOf(StmtKind kind) { return kStmtWords[static_cast<size_t>(kind)]; }

StmtKind statementOf(std::string_view word) {
  for (size_t i = 0; i < std::size(kStmtWords); ++i)
    if (!word.empty() && word == kStmtWords[i]) return static_cast<StmtKind>(i);
  return StmtKind::None;
}

bool isReserved(std::string_view name) {
  if (name.empty() || name[0] < 'a' || name[0] > 'z') return false;
  for (const char* word : kReserved)
    if (name == word) return true;
  for (const char* word : kExprWords)
    if (name == word) return true;
  if (statementOf(name) != StmtKind::None) return true;
  for (const TypeKeyword& row : kTypeKeywords)
    if (name == row.word) return true;
  Op op;
  return types::findOp(name, op);
}

uint8_t naturalCheck(Op op) { return op == Op::Div || op == Op::Mod ? kCheckDiv : kCheckOverflow; }

uint8_t naturalCheck(const TypeTable& types, const Expr& expr) {
  if (checksOf(expr.kind) == 0) return 0;
  if (expr.kind == ExprKind::Index) return kCheckIndex;
  if (isPlace(expr.kind)) return kCheckNull;
  if (expr.kind != ExprKind::Convert) return naturalCheck(expr.op());
  return types.kind(expr.type) == TypeKind::Subrange ? kCheckSubrange : kCheckConvert;
}

}  // namespace rung::ir::text_form
