// SPDX-License-Identifier: Apache-2.0
// Strings in C++: stored in place, NUL-terminated, cut to the capacity of their target; read without a
// copy, compared with short literals without a call.
//
// Gains (tests/bench/run.sh kernels, --checks=none): strings copied whole make `queue` 1.8 times as fast, literals
// compared by unit 1.2 times; literals compared whole save 58 % of the instructions of `recipes`.
#include <algorithm>

#include "codegen/body_parts.h"
#include "ir/builder.h"
#include "ir/string_end.h"
#include "ir/walk.h"

namespace rung::codegen {

namespace {

constexpr uint32_t kComparedWhole = 32;  // bytes of a literal that memcmp compares inline
constexpr uint32_t kComparedByUnit = 3;  // units of a literal that are compared one by one where memory may end

std::string_view upToNul(std::string_view string) { return string.substr(0, string.find('\0')); }

// The longest prefix of whole characters that fits `bytes` bytes of a USTRING.
std::string_view firstWhole(std::string_view string, uint32_t bytes) {
  if (string.size() <= bytes) return string;
  while (bytes > 0 && (static_cast<unsigned char>(string[bytes]) & 0xc0) == 0x80) --bytes;
  return string.substr(0, bytes);
}

// The first of the two UTF-16 units of a character of four bytes, in the form of a character of three.
std::string firstHalf(std::string_view character) {
  uint32_t point = static_cast<unsigned char>(character[0]) & 7;
  for (const char c : character.substr(1, 3)) point = point << 6 | (static_cast<unsigned char>(c) & 63);
  const uint32_t unit = 0xd800 + ((point - 0x10000) >> 10);
  return {static_cast<char>(0xe0 | unit >> 12), static_cast<char>(0x80 | (unit >> 6 & 63)),
          static_cast<char>(0x80 | (unit & 63))};
}

// The first `units` UTF-16 units of a UTF-8 string; of two that are one character the first may stay.
std::string firstUnits(std::string_view string, uint32_t units) {
  size_t at = 0;
  while (at < string.size()) {
    const auto lead = static_cast<unsigned char>(string[at]);
    const uint32_t width = lead >= 0xf0 ? 2 : 1;
    if (width > units) return std::string(string.substr(0, at)) + (units == 1 ? firstHalf(string.substr(at)) : "");
    units -= width;
    at += lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  }
  return std::string(string.substr(0, at));
}

}  // namespace

uint32_t StringWriter::literalLength(const Expr& e) const {
  const std::string_view literal = string(e.as<ir::StringExpr>().characters);
  return isWide(e.type) ? wideLength(literal) : static_cast<uint32_t>(upToNul(literal).size());
}

bool StringWriter::isBuffer(ExprId id, uint32_t& capacity) const {
  const Expr& e = expr(id);
  capacity = capacityOf(e.type);
  if (isSlice(id) || (ir::isPlace(e.kind) && ir::mayLackEnd(types_, *body_, id))) return false;
  if (const uint32_t* local = ir::localOf(e)) return !body_->locals[*local].by_reference;
  if (const auto* field = e.tryAs<ir::FieldExpr>()) return !fieldOf(*field).by_reference;
  return e.kind == ExprKind::Index;
}

void StringWriter::prepareString(ExprId from) {
  const Expr& e = expr(from);
  if (e.kind == ExprKind::Convert && isString(e.type)) {
    prepareString(e.as<ir::ConvertExpr>().operand);
    return;
  }
  checks().prepare(from);
}

void StringWriter::materializeString(ExprId id) {
  const Expr& e = expr(id);
  const std::string name = newVariable(e.type, "s");
  if (e.kind == ExprKind::Convert) {
    copyString({name, capacityOf(e.type), isWide(e.type), {}}, id);
  } else {  // a pure function: its string result is the last parameter
    std::string function = captured([&] { calls().callExpr(e); });
    function.pop_back();
    out_ += function + ", " + name;
    if (module_.body(e.as<ir::CallExpr>().callee).native) {
      out_ += ", ";
      appendUnsigned(out_, capacityOf(e.type));
    }
    out_ += ");";
  }
  out_ += ' ';
  state_.materialized.push_back({id.index, name});
}

// `length = function(to, limit, `, or without a length.
void StringWriter::beginCopy(const StringTarget& target, std::string_view function, uint32_t limit) {
  if (!target.length.empty()) {
    out_ += target.length;
    out_ += " = ";
  }
  out_ += function;
  out_ += '(';
  out_ += target.name;
  out_ += ", ";
  appendUnsigned(out_, limit);
  out_ += ", ";
}

void StringWriter::copyString(const StringTarget& target, ExprId from) {
  const Expr& e = expr(from);
  const bool same_units = isWide(e.type) == target.wide;
  if (e.kind == ExprKind::Zero) {
    copyLiteral(target, {}, false);
    // An initial value: the last unit too, since a program may write all characters in front of it one by one.
    out_ += ' ';
    out_ += target.name;
    out_ += '[';
    appendUnsigned(out_, target.capacity);
    out_ += "] = 0;";
  } else if (e.kind == ExprKind::String && same_units) {
    copyLiteral(target, upToNul(string(e.as<ir::StringExpr>().characters)), isUtf8(e.type));
  } else if (const auto* convert = e.tryAs<ir::ConvertExpr>(); convert != nullptr && same_units) {
    StringTarget cut = target;
    cut.capacity = std::min(target.capacity, capacityOf(e.type));
    if (isString(expr(convert->operand).type)) {
      copyString(cut, convert->operand);
      return;
    }
    beginCopy(target, target.wide ? "rung_wstring_of_scalar" : "rung_string_of_scalar", cut.capacity);
    out_ += typeKindName(types_, expr(convert->operand).type);
    out_ += ", ";
    values().scalarBits(convert->operand);
    out_ += ");";
  } else {
    copyVariable(target, from);
  }
}

void StringWriter::copyLiteral(const StringTarget& target, std::string_view literal, bool utf8) {
  std::string units;
  if (target.wide)
    literal = units = firstUnits(literal, target.capacity);
  else
    literal = utf8 ? firstWhole(literal, target.capacity) : literal.substr(0, target.capacity);
  if (literal.empty()) {
    out_ += target.name;
    out_ += "[0] = 0;";
  } else {
    out_ += "memcpy(";
    out_ += target.name;
    out_ += ", ";
    target.wide ? appendQuotedWide(out_, literal) : appendQuoted(out_, literal);
    out_ += ", ";
    appendUnsigned(out_, target.wide ? (uint64_t{wideLength(literal)} + 1) * 2 : literal.size() + 1);
    out_ += ");";
  }
  if (target.length.empty()) return;
  out_ += ' ';
  out_ += target.length;
  out_ += " = ";
  appendUnsigned(out_, static_cast<uint32_t>(literal.size()));
  out_ += ';';
}

void StringWriter::copyVariable(const StringTarget& target, ExprId from) {
  const TypeId type = expr(from).type;
  const bool wide = target.wide;
  const std::string source = captured([&] { stringValue(from); });
  if (source == target.name && target.capacity >= capacityOf(type)) return;
  const bool is_measured = isKnown(from);
  if (isWide(type) != wide) {
    beginCopy(target, wide ? "rung_wstring_of_string" : "rung_string_of_wstring", target.capacity);
  } else if (is_measured && !wide) {
    beginCopy(target, "rung_string_put", target.capacity);
    out_ += source + ", ";
    lengthName(from);
    out_ += ");";
    return;
  } else {
    beginCopy(target,
              wide           ? "rung_wstring_assign"
              : isUtf8(type) ? "rung_ustring_assign"
                             : "rung_string_assign",
              target.capacity);
  }
  out_ += source + ");";
}

void StringWriter::stringValue(ExprId id) {
  const Expr& e = expr(id);
  const bool wide = isWide(e.type);
  switch (e.kind) {
    case ExprKind::String:
      if (wide) {
        appendQuotedWide(out_, string(e.as<ir::StringExpr>().characters));
      } else {
        appendQuoted(out_, upToNul(string(e.as<ir::StringExpr>().characters)));
      }
      return;
    case ExprKind::Zero: out_ += wide ? "u\"\"" : "\"\""; return;
    case ExprKind::Data:
      out_ += wide ? "((const char16_t*)" : "((const char*)";
      places().dataReference(e.as<ir::DataExpr>().index);
      out_ += ')';
      return;
    case ExprKind::Convert:
    case ExprKind::Call:
      for (const auto& [created, name] : state_.materialized) {
        if (created == id.index) {
          out_ += name;
          return;
        }
      }
      if (const auto* cut = e.tryAs<ir::ConvertExpr>()) stringValue(cut->operand);
      return;
    case ExprKind::Select: {
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      out_ += '(';
      values().condition(decides, Prec::Or);
      out_ += wide ? " ? (const char16_t*)" : " ? (const char*)";
      stringValue(yes);
      out_ += " : ";
      stringValue(no);
      out_ += ')';
      return;
    }
    case ExprKind::Binary: {  // MIN, MAX
      const ir::BinaryExpr& node = e.as<ir::BinaryExpr>();
      const std::string a = captured([&] { stringValue(node.left); }), b = captured([&] { stringValue(node.right); });
      out_ += wide ? "(rung_wstring_compare(" : "(strcmp(";
      out_ += a + ", " + b + (node.op == Op::Min ? ") < 0 ? " : ") >= 0 ? ");
      out_ += wide ? "(const char16_t*)" : "(const char*)";
      out_ += a + " : " + b + ")";
      return;
    }
    case ExprKind::Local:
    case ExprKind::Field:
    case ExprKind::Index:
    case ExprKind::Deref:
      if (isSlice(id)) {
        sliceName(id);
      } else {
        places().place(id);
      }
      return;
    case ExprKind::Image:
      out_ += wide ? "(char16_t*)(" : "(char*)(";
      places().imageAddress(id);
      out_ += ')';
      return;
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Bits:
    case ExprKind::Unary:
    case ExprKind::Address: out_ += wide ? "u\"\"" : "\"\""; return;
  }
}

void StringWriter::compareStrings(const ir::BinaryExpr& node, Prec context) {
  const bool is_equality = node.op == Op::Eq || node.op == Op::Ne;
  const char* op = node.op == Op::Eq   ? " == 0"
                   : node.op == Op::Ne ? " != 0"
                   : node.op == Op::Lt ? " < 0"
                   : node.op == Op::Le ? " <= 0"
                   : node.op == Op::Gt ? " > 0"
                                       : " >= 0";
  ExprId a = node.left, b = node.right;
  const bool wide = isWide(expr(a).type);
  if (is_equality && expr(a).kind == ExprKind::String) std::swap(a, b);
  if (is_equality && expr(b).kind == ExprKind::String) {
    const uint32_t length = literalLength(expr(b));
    const std::string literal_name = captured([&] { stringValue(b); });
    const std::string name = captured([&] { stringValue(a); });
    uint32_t capacity = 0;
    const bool is_buffer = isBuffer(a, capacity);
    const uint32_t bytes = (length + 1) * (wide ? 2 : 1);
    if (isKnown(a)) {
      const std::string count = captured([&] { lengthName(a); });
      if (length == 0) {
        parenthesis(Prec::Equality, context);
        out_ += count + op;
        closeParenthesis(Prec::Equality, context);
        return;
      }
      out_ += node.op == Op::Eq ? "(" : "!(";
      out_ += count + " == ";
      appendUnsigned(out_, length);
      const std::string_view literal = string(expr(b).as<ir::StringExpr>().characters);
      if (length > capacityOf(expr(a).type)) {
        // Never equal; nothing is read outside of the string.
      } else if (length <= kComparedByUnit) {
        for (uint32_t i = 0; i < length; ++i) {
          out_ += " && " + name + "[";
          appendUnsigned(out_, i);
          out_ += "] == (char)";
          appendUnsigned(out_, static_cast<unsigned char>(literal[i]));
        }
      } else {
        out_ += " && memcmp(" + name + ", " + literal_name + ", ";
        appendUnsigned(out_, length);
        out_ += ") == 0";
      }
      out_ += ')';
      return;
    }
    if (length == 0) {
      parenthesis(Prec::Equality, context);
      out_ += name + "[0]" + op;
      closeParenthesis(Prec::Equality, context);
      return;
    }
    if (is_buffer && capacity >= length && bytes <= kComparedWhole) {
      parenthesis(Prec::Equality, context);
      out_ += "memcmp(" + name + ", " + literal_name + ", ";
      appendUnsigned(out_, bytes);
      out_ += ')';
      out_ += op;
      closeParenthesis(Prec::Equality, context);
      return;
    }
    if (!wide && length <= kComparedByUnit) {
      const std::string_view literal = string(expr(b).as<ir::StringExpr>().characters);
      out_ += node.op == Op::Eq ? "(" : "!(";
      for (uint32_t i = 0; i <= length; ++i) {
        if (i > 0) out_ += " && ";
        out_ += name + "[";
        appendUnsigned(out_, i);
        out_ += "] == (char)";
        appendUnsigned(out_, i < length ? static_cast<unsigned char>(literal[i]) : 0);
      }
      out_ += ')';
      return;
    }
  }
  if (lengths().isSizedComparison(node, [&](ExprId side) { return isKnown(side); })) {
    const std::string count = captured([&] { lengthName(a); });
    out_ += node.op == Op::Eq ? "(" : "!(";
    out_ += count + " == ";
    lengthName(b);
    out_ += " && memcmp(";
    stringValue(a);
    out_ += ", ";
    stringValue(b);
    out_ += ", " + count + ") == 0)";
    return;
  }
  const Prec own = is_equality ? Prec::Equality : Prec::Relation;
  parenthesis(own, context);
  out_ += wide ? "rung_wstring_compare(" : "strcmp(";
  stringValue(a);
  out_ += ", ";
  stringValue(b);
  out_ += ')';
  out_ += op;
  closeParenthesis(own, context);
}

}  // namespace rung::codegen
