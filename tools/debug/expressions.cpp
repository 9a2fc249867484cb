// SPDX-License-Identifier: Apache-2.0
#include "tools/debug/expressions.h"

#include <strings.h>

#include <bit>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "frontend/parse/parse.h"
#include "frontend/source/diagnostics.h"
#include "frontend/source/files.h"
#include "frontend/syntax/tree.h"
#include "sema/types/arithmetic.h"
#include "sema/types/types.h"
#include "stdlib/runtime/host/value_format.h"

namespace rung::debug {
namespace {

using types::TypeKind;

TypeKind kindOf(uint8_t kind) { return static_cast<TypeKind>(static_cast<int>(TypeKind::Bool) + (kind - RUNG_BOOL)); }
bool isScalarType(const rung_type& type) { return type.kind <= RUNG_UCHAR || type.kind == RUNG_ENUM; }
bool isText(const rung_type& type) {
  return type.kind == RUNG_STRING || type.kind == RUNG_WSTRING || type.kind == RUNG_USTRING;
}

// What a part of an expression is.
struct Operand {
  enum Kind : uint8_t { Place, Scalar, Literal, Text } kind = Scalar;  // Literal: a number without a type
  Variable place;
  types::Value value{types::kLInt, 0};
  std::string text;
};

}  // namespace

struct ParsedExpression {
  ParsedExpression(std::string_view text, Names& names, Dialect dialect) {
    root =
        text::parseExpression(tree, names, sources, sources.add("expression", std::string(text)), dialect, diagnostics);
  }
  Sources sources;
  Diagnostics diagnostics{sources};
  Tree tree;
  ExprId root;
};

struct Expressions::Parts {
  Parts(Execution& of_execution, Values& of_values, BeforeCycle before)
      : execution(of_execution), values(of_values), before_cycle(std::move(before)) {}

  Execution& execution;
  Values& values;
  BeforeCycle before_cycle;
  Names names;
  types::TypeTable table{names, sizeof(void*)};
  std::unordered_map<std::string, std::unique_ptr<ParsedExpression>> parsed;
  const Tree* tree = nullptr;
  const DebugFrame* frame = nullptr;
  uint32_t depth = 0;

  // The first failure counts; what is evaluated after it is of no use, and does no harm.
  Operand fail(std::string what) {
    if (error.empty()) error = std::move(what);
    return {};
  }
  const rung_module& module() const { return execution.module(); }

  const ParsedExpression& parse(std::string_view text) {
    constexpr size_t kMost = 256;
    if (parsed.size() > kMost) parsed.clear();
    std::unique_ptr<ParsedExpression>& known = parsed[std::string(text)];
    if (!known) known = std::make_unique<ParsedExpression>(text, names, execution.options().dialect);
    return *known;
  }

  // ---- places

  Variable element(Variable base, const IndexExpr& index) {
    std::string text = "[";
    for (const ExprId each : tree->list(index.indices)) {
      if (text.size() > 1) text += ',';
      text += std::to_string(scalarOf(evaluate(each)).asSigned());
    }
    return stepped(std::move(base), text + ']');
  }
  Variable stepped(Variable base, const std::string& text) {
    std::string why;
    if (!base.isEmpty() && !values.step(base, text, why)) {
      fail(why);
      base = {};
    }
    return base;
  }
  // Empty after a failure.
  Variable placeOf(ExprId id) {
    Operand operand = evaluate(id);
    if (operand.kind != Operand::Place) fail("this is not a variable");
    return operand.place;
  }
  Operand place(Variable variable) {
    if (variable.isEmpty()) return fail("this is not a variable");
    Operand operand;
    operand.kind = Operand::Place;
    operand.place = std::move(variable);
    return operand;
  }

  // Of the only enumeration that has such an item, or of the named one.
  bool findItem(std::string_view type_name, std::string_view name, Operand& to) {
    for (uint32_t t = 0; t < module().types.count; ++t) {
      const rung_type& type = *rung_type_at(&module(), t);
      if (type.kind != RUNG_ENUM) continue;
      const std::string_view known = module().strings + type.name;
      if (!type_name.empty() &&
          (known.size() != type_name.size() || strncasecmp(known.data(), type_name.data(), known.size()) != 0))
        continue;
      for (uint32_t i = 0; i < type.count; ++i) {
        const rung_enum_item& item = *rung_enum_item_at(&module(), type.first + i);
        const std::string_view item_name = module().strings + item.name;
        if (item_name.size() != name.size() || strncasecmp(item_name.data(), name.data(), name.size()) != 0) continue;
        to.kind = Operand::Literal;
        to.value = {types::kLInt, static_cast<uint64_t>(item.value)};
        return true;
      }
    }
    return false;
  }

  Operand name(ExprId id) {
    const std::string_view name = names.string(tree->as<NameExpr>(id).name);
    Operand item;
    Variable variable;
    if (values.find(frame, name, variable)) {
      if (is_past && Values::isOfCall(variable)) return fail("`" + std::string(name) + "` is a variable of the call");
      return place(variable);
    }
    if (findItem("", name, item)) return item;
    return fail("there is no variable `" + std::string(name) + "` here");
  }

  // `list.variable` where the base is not a variable, `Type.item`.
  Operand member(ExprId id) {
    const MemberExpr& node = tree->as<MemberExpr>(id);
    const std::string name(names.string(node.member));
    std::string why;
    if (tree->kind(node.base) == ExprKind::Name) {
      const std::string base(names.string(tree->as<NameExpr>(node.base).name));
      Variable found;
      Operand item;
      if (!values.find(frame, base, found)) {
        if (execution.session().symbols().find(base + '.' + name, found, why)) return place(found);
        if (findItem(base, name, item)) return item;
        if (execution.session().symbols().find(name, found, why)) return place(found);
      }
    }
    return place(stepped(placeOf(node.base), '.' + name));
  }

  // ---- values

  types::Value valueOf(const Variable& place) {
    if (place.type->kind == RUNG_POINTER) {
      uint64_t bits = 0;
      if (place.address() != nullptr) memcpy(&bits, place.address(), sizeof bits);
      return {types::kULInt, bits};
    }
    if (!isScalarType(*place.type)) return fail("an array, structure or text is not a number").value;
    const rung_type& type = place.type->kind == RUNG_ENUM ? *rung_type_at(&module(), place.type->element) : *place.type;
    uint64_t bits = 0;
    if (!rung_read_value(place.context, &place, &bits, place.type->size))
      return fail("a pointer on the path is null").value;
    const TypeKind kind = kindOf(type.kind);
    if (type.kind == RUNG_REAL)
      return types::Value::ofReal(types::kReal, std::bit_cast<float>(static_cast<uint32_t>(bits)));
    const uint32_t width = type.size * 8;
    if (type.is_signed != 0 && width < 64)
      bits = static_cast<uint64_t>(static_cast<int64_t>(bits << (64 - width)) >> (64 - width));
    return {types::idOf(kind), bits};
  }
  types::Value scalarOf(const Operand& operand) {
    if (operand.kind == Operand::Text) return fail("a text is not a number").value;
    return operand.kind == Operand::Place ? valueOf(operand.place) : operand.value;
  }
  std::string textOf(const Operand& operand) {
    if (operand.kind == Operand::Text) return operand.text;
    if (operand.kind != Operand::Place || !isText(*operand.place.type)) return fail("this is not a text").text;
    std::string text;
    host::formatValue(execution.session().module(), operand.place, text);
    return text.size() >= 2 ? text.substr(1, text.size() - 2) : text;
  }
  static bool isTextual(const Operand& operand) {
    return operand.kind == Operand::Text || (operand.kind == Operand::Place && isText(*operand.place.type));
  }

  Operand literal(ExprId id) {
    const LiteralExpr& node = tree->as<LiteralExpr>(id);
    Operand operand;
    const auto typed = [&](TypeId type, uint64_t bits) { operand.value = {type, bits}; };
    switch (node.literal()) {
      case LiteralKind::Bool: typed(types::kBool, node.value()); break;
      case LiteralKind::Integer:
        operand.kind = Operand::Literal;
        typed(types::kLInt, node.form.is_negative ? 0 - node.value() : node.value());
        break;
      case LiteralKind::Real:
        operand.kind = Operand::Literal;
        typed(types::kLReal, node.value());
        break;
      case LiteralKind::String:
      case LiteralKind::WString:
        operand.kind = Operand::Text;
        operand.text = tree->string(node.string());
        break;
      case LiteralKind::Duration: typed(types::kLTime, node.value()); break;
      case LiteralKind::Date: typed(types::idOf(TypeKind::LDate), node.value()); break;
      case LiteralKind::TimeOfDay: typed(types::idOf(TypeKind::LTimeOfDay), node.value()); break;
      case LiteralKind::DateTime: typed(types::idOf(TypeKind::LDateTime), node.value()); break;
      case LiteralKind::Null: typed(types::kULInt, 0); break;
    }
    return operand;
  }

  // ---- operators

  static bool isTimed(TypeId type) {
    return type.index >= types::kTime.index && type.index < types::idOf(TypeKind::Char).index;
  }
  // TIME and its like count in nanoseconds here.
  types::Value inNanoseconds(const types::Value& value) {
    static constexpr std::pair<TypeKind, TypeKind> kLong[] = {{TypeKind::Time, TypeKind::LTime},
                                                              {TypeKind::Date, TypeKind::LDate},
                                                              {TypeKind::TimeOfDay, TypeKind::LTimeOfDay},
                                                              {TypeKind::DateTime, TypeKind::LDateTime}};
    for (const auto& [from, to] : kLong)
      if (value.type == types::idOf(from)) return types::convert(table, value, types::idOf(to)).value;
    return value;
  }
  TypeId common(const types::Value& a, const types::Value& b, bool a_adapts, bool b_adapts) {
    const auto isReal = [](TypeId type) { return type == types::kReal || type == types::kLReal; };
    if (a.type == b.type) return a.type;
    if (a_adapts && !(isReal(a.type) && !isReal(b.type))) return b.type == types::kBool ? types::kLInt : b.type;
    if (b_adapts && !(isReal(b.type) && !isReal(a.type))) return a.type == types::kBool ? types::kLInt : a.type;
    if (isReal(a.type) || isReal(b.type)) return types::kLReal;
    return types::kLInt;
  }

  static types::Op operatorOf(BinaryOp op) {
    switch (op) {
      case BinaryOp::Or:
      case BinaryOp::OrElse: return types::Op::Or;
      case BinaryOp::Xor: return types::Op::Xor;
      case BinaryOp::And:
      case BinaryOp::AndThen: return types::Op::And;
      case BinaryOp::Equal: return types::Op::Eq;
      case BinaryOp::NotEqual: return types::Op::Ne;
      case BinaryOp::Less: return types::Op::Lt;
      case BinaryOp::LessEqual: return types::Op::Le;
      case BinaryOp::Greater: return types::Op::Gt;
      case BinaryOp::GreaterEqual: return types::Op::Ge;
      case BinaryOp::Add: return types::Op::Add;
      case BinaryOp::Subtract: return types::Op::Sub;
      case BinaryOp::Multiply: return types::Op::Mul;
      case BinaryOp::Divide: return types::Op::Div;
      case BinaryOp::Modulo: return types::Op::Mod;
      case BinaryOp::Power: return types::Op::Power;
    }
    return types::Op::Add;
  }

  Operand truth(bool value) {
    Operand operand;
    operand.value = {types::kBool, value ? 1u : 0u};
    return operand;
  }

  Operand compareTexts(types::Op op, const std::string& left, const std::string& right) {
    const int order = left.compare(right);
    if (op == types::Op::Eq) return truth(order == 0);
    if (op == types::Op::Ne) return truth(order != 0);
    if (op == types::Op::Lt) return truth(order < 0);
    if (op == types::Op::Le) return truth(order <= 0);
    if (op == types::Op::Gt) return truth(order > 0);
    if (op == types::Op::Ge) return truth(order >= 0);
    return fail("texts can be compared only");
  }

  Operand binary(ExprId id) {
    const BinaryExpr& node = tree->as<BinaryExpr>(id);
    const Operand left = evaluate(node.left);
    const types::Op op = operatorOf(node.op());
    if (node.op() == BinaryOp::AndThen || node.op() == BinaryOp::OrElse) {
      const bool first = scalarOf(left).bits != 0;
      if (first == (node.op() == BinaryOp::OrElse)) return truth(first);
    }
    const Operand right = evaluate(node.right);
    if (isTextual(left) || isTextual(right)) return compareTexts(op, textOf(left), textOf(right));
    return operate(op, left, right);
  }

  Operand operate(types::Op op, const Operand& left, const Operand& right) {
    types::Value a = inNanoseconds(scalarOf(left)), b = inNanoseconds(scalarOf(right));
    Operand result;
    const bool scales = (op == types::Op::Mul || op == types::Op::Div) && (isTimed(a.type) != isTimed(b.type));
    TypeId type = scales ? types::kLReal : common(a, b, left.kind == Operand::Literal, right.kind == Operand::Literal);
    const TypeId timed = isTimed(a.type) ? a.type : b.type;
    if (op == types::Op::Power) type = types::kLReal;
    if (!scales && isTimed(type) && a.type != b.type) type = types::kLTime;
    const auto prepare = [&](const types::Value& value) {
      if (isTimed(value.type) && type != value.type)
        return types::convert(table, {types::kLInt, value.bits}, type).value;
      return types::convert(table, value, type).value;
    };
    a = prepare(a);
    b = prepare(b);
    const types::Outcome outcome = types::apply(table, names, op, a, b);
    if (outcome.fault != types::Fault::None) return fail("division by zero");
    result.value = outcome.value;
    if (scales) result.value = {timed, types::convert(table, outcome.value, types::kLInt).value.bits};
    if (left.kind == Operand::Literal && right.kind == Operand::Literal && !types::isComparison(op))
      result.kind = Operand::Literal;
    return result;
  }

  Operand unary(ExprId id) {
    const UnaryExpr& node = tree->as<UnaryExpr>(id);
    Operand operand = evaluate(node.operand);
    if (node.op() == UnaryOp::Plus) return operand;
    Operand result;
    result.kind = operand.kind == Operand::Literal ? Operand::Literal : Operand::Scalar;
    result.value = types::apply(table, names, node.op() == UnaryOp::Not ? types::Op::Not : types::Op::Neg,
                                inNanoseconds(scalarOf(operand)))
                       .value;
    return result;
  }

  // ---- functions without effects

  Operand call(ExprId id) {
    const CallExpr& node = tree->as<CallExpr>(id);
    std::string name = tree->kind(node.callee) == ExprKind::Name
                           ? host::lowerCase(names.string(tree->as<NameExpr>(node.callee).name))
                           : std::string();
    std::vector<ExprId> arguments;
    for (const Argument& argument : tree->list(node.arguments)) arguments.push_back(argument.value);
    if (name == "prev" && arguments.size() == 1) return previous(arguments[0]);
    if (name == "abs" && arguments.size() == 1) {
      Operand result;
      result.value = types::apply(table, names, types::Op::Abs, scalarOf(evaluate(arguments[0]))).value;
      return result;
    }
    if ((name == "min" || name == "max") && arguments.size() == 2)
      return operate(name == "min" ? types::Op::Min : types::Op::Max, evaluate(arguments[0]), evaluate(arguments[1]));
    const size_t to = name.find("to_");
    if (to != std::string::npos && arguments.size() == 1 && (to == 0 || name[to - 1] == '_')) {
      for (uint32_t kind = RUNG_BOOL; kind <= RUNG_LREAL; ++kind) {
        const TypeId type = types::idOf(kindOf(static_cast<uint8_t>(kind)));
        if (host::lowerCase(table.toString(type)) != name.substr(to + 3)) continue;
        Operand result;
        result.value = types::convert(table, inNanoseconds(scalarOf(evaluate(arguments[0]))), type).value;
        return result;
      }
    }
    return fail("only functions without effects can be called here: conversions, ABS, MIN, MAX and prev");
  }

  Operand previous(ExprId id) {
    Operand result;
    is_past = true;
    const bool looked = before_cycle && before_cycle([&] { result = fixed(evaluate(id)); });
    is_past = false;
    return looked ? result : fail("prev cannot be asked here");
  }
  // A value that stays when the program goes somewhere else.
  Operand fixed(const Operand& operand) {
    if (operand.kind != Operand::Place) return operand;
    Operand result;
    if (isText(*operand.place.type)) {
      result.kind = Operand::Text;
      result.text = textOf(operand);
    } else {
      result.value = valueOf(operand.place);
    }
    return result;
  }

  Operand evaluate(ExprId id) {
    constexpr uint32_t kDeepest = 200;
    struct Level {
      uint32_t& depth;
      explicit Level(uint32_t& of) : depth(of) { ++depth; }
      ~Level() { --depth; }
    } level(depth);
    if (depth > kDeepest) return fail("the expression is nested too deeply");
    const ExprKind kind = tree->kind(id);
    if (kind == ExprKind::Literal) return literal(id);
    if (kind == ExprKind::Name) return name(id);
    if (kind == ExprKind::Member) return member(id);
    if (kind == ExprKind::Index) return place(element(placeOf(tree->as<IndexExpr>(id).base), tree->as<IndexExpr>(id)));
    if (kind == ExprKind::Deref) return place(dereferenced(id));
    if (kind == ExprKind::This || kind == ExprKind::Super) return instance();
    if (kind == ExprKind::BitAccess) return bit(tree->as<BitAccessExpr>(id));
    if (kind == ExprKind::TypedName) return typedName(tree->as<TypedNameExpr>(id));
    if (kind == ExprKind::Address) return address(tree->as<AddressExpr>(id));
    if (kind == ExprKind::Unary) return unary(id);
    if (kind == ExprKind::Binary) return binary(id);
    if (kind == ExprKind::Call) return call(id);
    return fail("this cannot be evaluated here");
  }
  Operand instance() {
    Variable self;
    if (frame == nullptr || !values.instanceOf(*frame, self)) return fail("there is no instance here");
    return place(self);
  }
  Operand bit(const BitAccessExpr& node) {
    if (node.width != 1) return fail("of a word, only bits can be asked here");
    return place(stepped(placeOf(node.base), '.' + std::to_string(node.position)));
  }
  Operand typedName(const TypedNameExpr& node) {
    Operand item;
    if (findItem(names.string(node.type_name.name), names.string(node.item.name), item)) return item;
    return fail("there is no such value of an enumeration");
  }
  Operand address(const AddressExpr& node) {
    std::string path = {'%', node.address.area}, why;
    if (node.address.size_given) path += node.address.size;
    const char* separator = "";
    for (const uint32_t number : tree->list(node.address.path)) {
      path += separator + std::to_string(number);
      separator = ".";
    }
    Variable variable;
    if (!execution.session().symbols().find(path, variable, why)) return fail(why);
    return place(variable);
  }
  Variable dereferenced(ExprId id) {
    const ExprId base = tree->as<DerefExpr>(id).base;
    if (tree->kind(base) == ExprKind::This || tree->kind(base) == ExprKind::Super) return placeOf(base);
    return stepped(placeOf(base), "^");
  }

  Evaluated shown(const Operand& operand) {
    Evaluated result;
    if (operand.kind == Operand::Place) {
      const ShownVariable variable = values.show("", operand.place);
      result.value = variable.value;
      result.type = variable.type;
      result.place = operand.place;
      result.named = variable.named;
      result.indexed = variable.indexed;
      result.is_bool = operand.place.type->kind == RUNG_BOOL;
      result.truth = result.is_bool && valueOf(operand.place).bits != 0;
      return result;
    }
    if (operand.kind == Operand::Text) {
      result.value = '\'' + operand.text + '\'';
      result.type = "STRING";
      return result;
    }
    result.value = types::toString(table, names, operand.value);
    result.type = table.toString(operand.value.type);
    result.is_bool = operand.value.type == types::kBool;
    result.truth = operand.value.bits != 0;
    return result;
  }

  std::string error;
  bool is_past = false;
};

Expressions::Expressions(Execution& execution, Values& values, BeforeCycle before_cycle)
    : parts_(std::make_unique<Parts>(execution, values, std::move(before_cycle))) {}
Expressions::~Expressions() = default;

std::string Expressions::check(std::string_view text) {
  const ParsedExpression& parsed = parts_->parse(text);
  if (parsed.root && !parsed.diagnostics.hasErrors()) return "";
  return "`" + std::string(text) + "` is not an expression of ST";
}

Evaluated Expressions::evaluate(std::string_view text, const DebugFrame* frame) {
  Evaluated result;
  result.error = check(text);
  if (!result.error.empty()) return result;
  const ParsedExpression& parsed = parts_->parse(text);
  parts_->tree = &parsed.tree;
  parts_->frame = frame;
  parts_->error.clear();
  const Operand operand = parts_->evaluate(parsed.root);
  if (parts_->error.empty()) result = parts_->shown(operand);
  result.error = parts_->error;
  return result;
}

}  // namespace rung::debug
