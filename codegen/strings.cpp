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
  const Ex name = newVariable(e.type, "s");
  if (e.kind == ExprKind::Convert) {
    copyString({name, capacityOf(e.type), isWide(e.type), nullptr}, id);
  } else {  // a pure function: its string result is the last parameter
    CallWriter::Parts call = calls().parts(e);
    call.arguments.push_back(name);
    if (module_.body(e.as<ir::CallExpr>().callee).native) call.arguments.push_back(tree_.number(capacityOf(e.type)));
    perform(tree_.call(call.function, call.arguments));
  }
  state_.materialized.push_back({id.index, name});
}

// `function(to, limit, from…)`, whose result is the new length.
void StringWriter::copyBy(const char* function, const StringTarget& target, uint32_t limit, std::vector<Ex> from) {
  std::vector<Ex> arguments{target.name, tree_.number(limit)};
  arguments.insert(arguments.end(), from.begin(), from.end());
  const Ex copy = tree_.call(function, arguments);
  target.length != nullptr ? assign(target.length, copy) : perform(copy);
}

void StringWriter::copyString(const StringTarget& target, ExprId from) {
  const Expr& e = expr(from);
  const bool same_units = isWide(e.type) == target.wide;
  if (e.kind == ExprKind::Zero) {
    copyLiteral(target, {}, false);
    // An initial value: the last unit too, since a program may write all characters in front of it one by one.
    assign(tree_.element(target.name, tree_.number(target.capacity)), tree_.number(0));
  } else if (e.kind == ExprKind::String && same_units) {
    copyLiteral(target, upToNul(string(e.as<ir::StringExpr>().characters)), isUtf8(e.type));
  } else if (const auto* convert = e.tryAs<ir::ConvertExpr>(); convert != nullptr && same_units) {
    StringTarget cut = target;
    cut.capacity = std::min(target.capacity, capacityOf(e.type));
    if (isString(expr(convert->operand).type)) return copyString(cut, convert->operand);
    copyBy(target.wide ? "rung_wstring_of_scalar" : "rung_string_of_scalar", target, cut.capacity,
           {tree_.fixed(typeKindName(types_, expr(convert->operand).type)), values().scalarBits(convert->operand)});
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
    assign(tree_.element(target.name, tree_.number(0)), tree_.number(0));
  } else {
    const uint64_t bytes = target.wide ? (uint64_t{wideLength(literal)} + 1) * 2 : literal.size() + 1;
    perform(tree_.call("memcpy", {target.name, quoted(literal, target.wide), tree_.number(bytes)}));
  }
  if (target.length != nullptr) assign(target.length, tree_.number(literal.size()));
}

void StringWriter::copyVariable(const StringTarget& target, ExprId from) {
  const TypeId type = expr(from).type;
  const bool wide = target.wide;
  const Ex source = stringValue(from);
  if (target.capacity >= capacityOf(type) && cxx::same(source, target.name)) return;
  if (isWide(type) != wide) {
    copyBy(wide ? "rung_wstring_of_string" : "rung_string_of_wstring", target, target.capacity, {source});
  } else if (isKnown(from) && !wide) {
    copyBy("rung_string_put", target, target.capacity, {source, lengthName(from)});
  } else {
    copyBy(assignFunction(type), target, target.capacity, {source});
  }
}

const char* StringWriter::assignFunction(TypeId type) const {
  return isWide(type) ? "rung_wstring_assign" : isUtf8(type) ? "rung_ustring_assign" : "rung_string_assign";
}

cxx::Ex StringWriter::stringValue(ExprId id) {
  const Expr& e = expr(id);
  const bool wide = isWide(e.type);
  const char* const pointer = wide ? "const char16_t*" : "const char*";
  switch (e.kind) {
    case ExprKind::String: {
      const std::string_view characters = string(e.as<ir::StringExpr>().characters);
      return quoted(wide ? characters : upToNul(characters), wide);
    }
    case ExprKind::Zero: return quoted("", wide);
    case ExprKind::Data: return tree_.group(tree_.cast(pointer, places().dataReference(e.as<ir::DataExpr>().index)));
    case ExprKind::Convert:
    case ExprKind::Call: {
      const auto* cut = e.tryAs<ir::ConvertExpr>();
      return cut != nullptr && !places().isMaterialized(id) ? stringValue(cut->operand) : places().materialized(id);
    }
    case ExprKind::Select: {
      const auto [decides, yes, no] = e.as<ir::SelectExpr>();
      const Ex test = values().condition(decides), first = stringValue(yes), second = stringValue(no);
      return tree_.group(tree_.choice(test, tree_.cast(pointer, first), second));
    }
    case ExprKind::Binary: {  // MIN, MAX
      const ir::BinaryExpr& node = e.as<ir::BinaryExpr>();
      const Ex a = stringValue(node.left), b = stringValue(node.right);
      const Operator op = node.op == Op::Min ? Operator::Less : Operator::GreaterEqual;
      const Ex test = tree_.infix(op, compared(wide, a, b), tree_.number(0));
      return tree_.group(tree_.choice(test, tree_.cast(pointer, a), b));
    }
    case ExprKind::Local:
    case ExprKind::Field:
    case ExprKind::Index:
    case ExprKind::Deref: return isSlice(id) ? sliceName(id) : places().place(id);
    case ExprKind::Image: return tree_.cast(wide ? "char16_t*" : "char*", tree_.group(places().imageAddress(id)));
    case ExprKind::None:
    case ExprKind::Const:
    case ExprKind::Self:
    case ExprKind::Global:
    case ExprKind::Program:
    case ExprKind::Bits:
    case ExprKind::Unary:
    case ExprKind::Address: return quoted("", wide);
  }
  return nullptr;
}

// ---- comparisons

cxx::Ex StringWriter::compared(bool wide, Ex a, Ex b) {
  return tree_.call(wide ? "rung_wstring_compare" : "strcmp", {a, b});
}

// `memcmp(a, b, count) == 0`
cxx::Ex StringWriter::sameBytes(Ex a, Ex b, Ex count) {
  return tree_.infix(Operator::Equal, tree_.call("memcmp", {a, b, count}), tree_.number(0));
}

// `name[i] == (char)65`
cxx::Ex StringWriter::hasUnit(Ex name, uint32_t i, char unit) {
  const Ex code = tree_.number(static_cast<unsigned char>(unit));
  return tree_.infix(Operator::Equal, tree_.element(name, tree_.number(i)), tree_.cast("char", code));
}

// `(test)` or `!(test)`
cxx::Ex StringWriter::asEquality(Operator op, Ex test) {
  return op == Operator::Equal ? tree_.group(test) : tree_.prefix("!", tree_.group(test));
}

cxx::Ex StringWriter::compareStrings(Operator op, const ir::BinaryExpr& node) {
  const bool is_equality = op == Operator::Equal || op == Operator::Differs;
  ExprId a = node.left, b = node.right;
  const bool wide = isWide(expr(a).type);
  if (is_equality && expr(a).kind == ExprKind::String) std::swap(a, b);
  if (is_equality && expr(b).kind == ExprKind::String)
    if (const Ex test = compareLiteral(op, a, b)) return test;
  if (lengths().isSizedComparison(node, [&](ExprId side) { return isKnown(side); })) {
    const Ex count = lengthName(a);
    const Ex is_as_long = tree_.infix(Operator::Equal, count, lengthName(b));
    const Ex left = stringValue(a), right = stringValue(b);
    return asEquality(op, tree_.infix(Operator::And, is_as_long, sameBytes(left, right, count)));
  }
  const Ex left = stringValue(a), right = stringValue(b);
  return tree_.infix(op, compared(wide, left, right), tree_.number(0));
}

// Equality with a literal, where it takes no call; else nothing.
cxx::Ex StringWriter::compareLiteral(Operator op, ExprId a, ExprId b) {
  const bool wide = isWide(expr(a).type);
  const uint32_t length = literalLength(expr(b));
  const std::string_view literal = string(expr(b).as<ir::StringExpr>().characters);
  const Ex name = stringValue(a), zero = tree_.number(0);
  if (isKnown(a)) {
    const Ex count = lengthName(a);
    if (length == 0) return tree_.infix(op, count, zero);
    Ex test = tree_.infix(Operator::Equal, count, tree_.number(length));
    if (length > capacityOf(expr(a).type)) {
      // Never equal; nothing is read outside of the string.
    } else if (length <= kComparedByUnit) {
      for (uint32_t i = 0; i < length; ++i) test = tree_.infix(Operator::And, test, hasUnit(name, i, literal[i]));
    } else {
      test = tree_.infix(Operator::And, test, sameBytes(name, stringValue(b), tree_.number(length)));
    }
    return asEquality(op, test);
  }
  if (length == 0) return tree_.infix(op, tree_.element(name, zero), zero);
  uint32_t capacity = 0;
  const uint32_t bytes = (length + 1) * (wide ? 2 : 1);
  if (isBuffer(a, capacity) && capacity >= length && bytes <= kComparedWhole)
    return tree_.infix(op, tree_.call("memcmp", {name, stringValue(b), tree_.number(bytes)}), zero);
  if (wide || length > kComparedByUnit) return nullptr;
  Ex test = hasUnit(name, 0, literal[0]);
  for (uint32_t i = 1; i <= length; ++i)
    test = tree_.infix(Operator::And, test, hasUnit(name, i, i < length ? literal[i] : '\0'));
  return asEquality(op, test);
}

}  // namespace rung::codegen
