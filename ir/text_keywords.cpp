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
constexpr const char* kReserved[] = {
    "address",  "array",    "assert",  "assert_eq", "assert_near", "bind",     "break",   "call",   "case",
    "catch",    "continue", "convert", "data",      "else",        "evaluate", "false",   "fault",  "finally",
    "for",      "if",       "in",      "inf",       "init",        "inout",    "jump",    "label",  "loop",
    "nan",      "next",     "null",    "of",        "on",          "out",      "pointer", "ref",    "reference",
    "result",   "return",   "select",  "self",      "string",      "switch",   "temp",    "to",     "true",
    "try",      "value",    "var",     "wstring",   "ustring",     "zero",     "by",      "retain", "persistent",
    "constant", "text",     "shows",   "class",     "base"};
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

bool isReserved(std::string_view name) {
  if (name.empty() || name[0] < 'a' || name[0] > 'z') return false;
  for (const char* word : kReserved)
    if (name == word) return true;
  for (const TypeKeyword& row : kTypeKeywords)
    if (name == row.word) return true;
  Op op;
  return types::findOp(name, op);
}

uint8_t naturalCheck(const TypeTable& types, const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::Binary: return expr.op == Op::Div || expr.op == Op::Mod ? kCheckDiv : kCheckOverflow;
    case ExprKind::Unary: return kCheckOverflow;
    case ExprKind::Index: return kCheckIndex;
    case ExprKind::Deref:
    case ExprKind::Field: return kCheckNull;
    case ExprKind::Convert: return types.kind(expr.type) == TypeKind::Subrange ? kCheckSubrange : kCheckConvert;
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::String:
    case ExprKind::Data:
    case ExprKind::Zero:
    case ExprKind::Local:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Image:
    case ExprKind::Bits:
    case ExprKind::Select:
    case ExprKind::Call:
    case ExprKind::Address: return 0;
  }
  return 0;
}

}  // namespace rung::ir::text_form
