// SPDX-License-Identifier: Apache-2.0
// Prints the code of a body: statements, places, values (docs/ir.md). Called by text_printer.cpp.
#include <cmath>

#include "ir/text_writer.h"
#include "ir/walk.h"

namespace rung::ir::text_form {

using types::Field;
using types::TypeInfo;
using types::TypeKind;

// ---- statements

// The statements and the closing brace; the caller has printed the opening one.
void Printer::block(StmtId first) {
  ++indent_;
  for (StmtId id = first; id;) {
    const Stmt& s = body_->stmt(id);
    newLine();
    id = s.next;
    if (givesResult(s)) {
      const AssignStmt& result = s.as<AssignStmt>();
      put("return ");
      expr(result.value, typeOf(result.place));
      id = body_->stmt(id).next;
    } else {
      stmt(s);
    }
  }
  --indent_;
  newLine();
  put("}");
}

// An assignment to the result before a return.
bool Printer::givesResult(const Stmt& s) const {
  if (s.kind != StmtKind::Assign || !s.next || body_->stmt(s.next).kind != StmtKind::Return) return false;
  const auto* place = body_->expr(s.as<AssignStmt>().place).tryAs<LocalExpr>();
  return place != nullptr && body_->locals[place->local].kind == LocalKind::Result;
}

void Printer::calleeOperands(const Body& callee, Slice<ExprId> operands) {
  put("(");
  uint32_t i = 0;
  for (const Local& parameter : parameters(callee)) {
    if (i == operands.count) break;
    if (i > 0) put(", ");
    if (const ExprId id = body_->list(operands)[i++])
      expr(id, types_.resolve(parameter.type));
    else
      put("_");
  }
  put(")");
}

void Printer::callStmt(const CallStmt& call) {
  const Body& callee = module_.body(call.callee);
  if (call.result) {
    expr(call.result, {});
    put(" = ");
  }
  put(callee.kind == BodyKind::Init ? "call init @"
      : !call.is_virtual            ? "call @"
      : call.is_checked             ? "call virtual checked @"
                                    : "call virtual @");
  name(callee.name);
  if (callee.kind == BodyKind::Function || !call.operands.empty()) calleeOperands(callee, call.operands);
  if (call.self) {
    put(" on ");
    expr(call.self, {});
  }
}

// A block, or a word and a block, if there is one.
void Printer::optionalBlock(const char* words, StmtId first) {
  if (!first) return;
  put(words);
  block(first);
}

void Printer::switchStmt(const SwitchStmt& node) {
  put("switch ");
  expr(node.selector, {});
  put(" {");
  const bool is_signed = types_.isSigned(types_.plainKind(typeOf(node.selector)));
  auto bound = [&](int64_t value) { is_signed ? signedNumber(value) : number(static_cast<uint64_t>(value)); };
  ++indent_;
  for (const Case& one : body_->list(node.cases)) {
    newLine();
    const char* separator = "case ";
    for (const CaseRange& range : body_->list(one.ranges)) {
      put(separator);
      separator = ", ";
      bound(range.low);
      if (range.high != range.low) {
        put("..");
        bound(range.high);
      }
    }
    put(" {");
    block(one.block);
  }
  if (node.else_block) newLine();
  optionalBlock("else {", node.else_block);
  --indent_;
  newLine();
  put("}");
}

void Printer::tryStmt(const TryStmt& node) {
  put("try {");
  block(node.body_block);
  if (node.catches) {
    put(" catch ");
    if (node.number) {
      expr(node.number, {});
      put(" ");
    }
    put("{");
    block(node.catch_block);
  }
  optionalBlock(" finally {", node.finally_block);
}

void Printer::assertStmt(const AssertStmt& node) {
  switch (node.assertion) {
    case Assertion::Assert:
      put("assert ");
      expr(node.first, types::kBool);
      if (node.second) {
        put(" shows ");
        expr(node.second, {});
        put(", ");
        expr(node.third, typeOf(node.second));
        put(" as ");
        quoted(module_.names.string(node.shown), '\'');
      }
      break;
    case Assertion::AssertEq:
    case Assertion::AssertNear:
      put(node.assertion == Assertion::AssertEq ? "assert_eq " : "assert_near ");
      expr(node.first, {});
      put(", ");
      expr(node.second, typeOf(node.first));
      if (node.third) {
        put(", ");
        expr(node.third, typeOf(node.first));
      }
      break;
  }
  if (node.text) {
    put(" text ");
    quoted(module_.names.string(node.text), '\'');
  } else if (node.message) {
    put(" message ");
    expr(node.message, {});
  }
}

void Printer::forStmt(const ForStmt& node) {
  const TypeId type = typeOf(node.control);
  put("for ");
  expr(node.control, {});
  put(" = ");
  expr(node.from, type);
  put(" to ");
  expr(node.to, type);
  put(" by ");
  expr(node.step, type);
  put(" {");
  block(node.body_block);
}

void Printer::stmt(const Stmt& s) {
  const auto word = [&](const char* after = " ") {
    put(wordOf(s.kind));
    put(after);
  };
  switch (s.kind) {
    case StmtKind::None: return put("none");
    case StmtKind::Assign: {
      const AssignStmt& node = s.as<AssignStmt>();
      expr(node.place, {});
      put(" = ");
      return expr(node.value, typeOf(node.place));
    }
    case StmtKind::Bind: {
      const BindStmt& node = s.as<BindStmt>();
      word();
      expr(node.field, {});
      put(" = ");
      return node.place ? expr(node.place, typeOf(node.field)) : put("null");
    }
    case StmtKind::Call: return callStmt(s.as<CallStmt>());
    case StmtKind::If: {
      const IfStmt& node = s.as<IfStmt>();
      word();
      expr(node.condition, types::kBool);
      put(" {");
      block(node.then_block);
      return optionalBlock(" else {", node.else_block);
    }
    case StmtKind::Switch: return switchStmt(s.as<SwitchStmt>());
    case StmtKind::Loop:
      word(" {");
      block(s.as<LoopStmt>().body_block);
      return optionalBlock(" next {", s.as<LoopStmt>().next_block);
    case StmtKind::For: return forStmt(s.as<ForStmt>());
    case StmtKind::Break:
    case StmtKind::Continue:
    case StmtKind::Return: return word("");
    case StmtKind::Jump: word(); return name(body_->labels[s.as<JumpStmt>().label]);
    case StmtKind::Label: word(); return name(body_->labels[s.as<LabelStmt>().label]);
    case StmtKind::Try: return tryStmt(s.as<TryStmt>());
    case StmtKind::Fault: {
      const FaultStmt& node = s.as<FaultStmt>();
      word();
      put(types::word(node.fault));
      if (!node.value) return;
      put("(");
      expr(node.value, {});
      return put(")");
    }
    case StmtKind::Assert: return assertStmt(s.as<AssertStmt>());
    case StmtKind::Evaluate: word(); return expr(s.as<EvaluateStmt>().value, {});
  }
}

// ---- expressions

void Printer::checks(const Expr& e) {
  if (e.checks == 0) return;
  put("!");
  if (e.checks == naturalCheck(types_, e)) return;
  put("(");
  bool first = true;
  for (const CheckKeyword& row : checkKeywords()) {
    if ((e.checks & row.check) == 0) continue;
    if (!first) put(", ");
    first = false;
    put(row.word);
  }
  put(")");
}

// A literal with its type before it, unless that is what the reader expects.
void Printer::constant(const Expr& e, TypeId expected) {
  const auto* value = e.tryAs<ConstExpr>();
  if (value != nullptr && value->number_of) {
    put("class ");
    return type(value->number_of);
  }
  const TypeId id = types_.resolve(e.type);
  const TypeInfo& info = types_.info(id);
  bool prefix = id != (expected ? types_.resolve(expected) : TypeId{});
  if (!expected && value != nullptr && (id == kDefaultInteger || id == types::kBool || id == types::kReal))
    prefix = false;
  NameId item;
  if (value != nullptr && info.kind == TypeKind::Enum) {
    for (const auto& [item_name, number] : info.items) {
      if (number != static_cast<int64_t>(uint64_t{value->bits})) continue;
      item = item_name;
      break;
    }
  }
  if (prefix || item) {
    type(id);
    put("#");
  }
  if (e.kind == ExprKind::Zero) return put("zero");
  if (const auto* string = e.tryAs<StringExpr>()) return quoted(module_.names.string(string->characters), '\'');
  if (item) return name(item);
  scalar({id, value->bits});
}

void Printer::scalar(const types::Value& value) {
  const TypeKind kind = types_.plainKind(value.type);
  if (kind == TypeKind::Bool && value.bits <= 1) {
    put(value.bits != 0 ? "true" : "false");
  } else if (TypeTable::isReal(kind)) {
    real(value, kind);
  } else if ((kind == TypeKind::Pointer || kind == TypeKind::Reference) && value.bits == 0) {
    put("null");
  } else if (types_.isSigned(kind)) {
    signedNumber(static_cast<int64_t>(value.bits));
  } else {
    number(value.bits);
  }
}

void Printer::real(const types::Value& value, TypeKind kind) {
  const double real = value.asReal();
  if (std::isnan(real)) {
    put("nan");
    if (value.bits == types::Value::ofReal(value.type, std::nan("")).bits) return;
    put("(");
    number(value.bits);
    put(")");
  } else if (std::isinf(real)) {
    put(real < 0 ? "-inf" : "inf");
  } else {
    char digits[40];
    char* end = kind == TypeKind::Real ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(real)).ptr
                                       : std::to_chars(digits, digits + sizeof digits, real).ptr;
    const std::string_view text(digits, static_cast<size_t>(end - digits));
    put(text);
    if (text.find_first_of(".e") == std::string_view::npos) put(".0");
  }
}

// As operand of a prefix keyword or base of a postfix: in parentheses unless it is one token.
void Printer::operand(ExprId id, TypeId expected) {
  const ExprKind kind = body_->expr(id).kind;
  const bool is_token = roleOf(kind) != ExprRole::Value || kind == ExprKind::Call;
  if (!is_token) put("(");
  expr(id, expected);
  if (!is_token) put(")");
}

void Printer::localName(const Local& local) {
  if (local.kind == LocalKind::Result) return put("result");
  if (local.kind == LocalKind::Temp) put("%");
  name(local.name);
}

void Printer::place(const Expr& e) {
  switch (placeKind(e.kind)) {
    case PlaceKind::Local: return localName(body_->locals[e.as<LocalExpr>().local]);
    case PlaceKind::Self: return put("self");
    case PlaceKind::Global: put("@"); return name(module_.lists[e.as<GlobalExpr>().list].name);
    case PlaceKind::Program: return programName(e.as<ProgramExpr>().program);
    case PlaceKind::Image: {
      const ImageExpr& image = e.as<ImageExpr>();
      type(e.type);
      put("%");
      out += module_.areas[image.area].letter;
      number(image.byte);
      if (image.bit == kNoBit) return;
      put(".");
      return number(image.bit);
    }
    case PlaceKind::Field: {
      const FieldExpr& node = e.as<FieldExpr>();
      const Expr& base = body_->expr(node.base);
      const Field& field = types_.info(types_.resolve(base.type)).fields[node.field];
      if (base.kind != ExprKind::Self || local_names_.count(field.name.index) != 0) {
        operand(node.base, {});
        put(".");
      }
      return name(field.name);
    }
    case PlaceKind::Index: {
      const IndexExpr& node = e.as<IndexExpr>();
      operand(node.base, {});
      for (uint32_t i = 0; i < node.indices.count; ++i) {
        put(i == 0 ? "[" : ", ");
        if (e.isProven(i)) put("=");
        expr(body_->list(node.indices)[i], {});
      }
      return put("]");
    }
    case PlaceKind::Deref: operand(e.as<DerefExpr>().pointer, {}); return put("^");
    case PlaceKind::Bits:
      operand(e.as<BitsExpr>().base, {});
      put(bitsWord(types_.kind(e.type)));
      return number(e.as<BitsExpr>().position);
  }
}

// A word, its checks, a type, and operands: `div! int x, y`, or `sub= int x, y` of which nothing is cut.
void Printer::prefixed(const char* word, const Expr& e, TypeId of) {
  put(word);
  checks(e);
  if (e.proven != 0) put("=");
  put(" ");
  type(of);
  put(" ");
}

void Printer::expr(ExprId id, TypeId expected) {
  const Expr& e = body_->expr(id);
  if (isPlace(e.kind)) {
    place(e);
    return checks(e);
  }
  switch (valueKind(e.kind)) {
    case ValueKind::None: return put("none");
    case ValueKind::Const:
    case ValueKind::String:
    case ValueKind::Zero: return constant(e, expected);
    case ValueKind::Data: put("data "); return number(e.as<DataExpr>().index);
    case ValueKind::Unary: prefixed(types::word(e.op()), e, e.type); return operand(e.as<UnaryExpr>().operand, e.type);
    case ValueKind::Binary: {
      const BinaryExpr& node = e.as<BinaryExpr>();
      const TypeId of = types::isComparison(node.op) ? typeOf(node.left) : e.type;
      prefixed(types::word(node.op), e, of);
      operand(node.left, of);
      put(", ");
      return operand(node.right, of);
    }
    case ValueKind::Convert:
      if (e.as<ConvertExpr>().rounding == types::Rounding::AwayFromZero) {
        prefixed("round", e, e.type);
        return operand(e.as<ConvertExpr>().operand, {});
      }
      [[fallthrough]];
    case ValueKind::Address:
      prefixed(wordOf(e.kind), e, e.type);
      return forEachOperand(*body_, e, [&](ExprId below) { operand(below, {}); });
    case ValueKind::Select: {
      const SelectExpr& node = e.as<SelectExpr>();
      prefixed(wordOf(e.kind), e, e.type);
      operand(node.condition, types::kBool);
      put(", ");
      operand(node.when_true, e.type);
      put(", ");
      return operand(node.when_false, e.type);
    }
    case ValueKind::Call: {
      const CallExpr& node = e.as<CallExpr>();
      const Body& callee = module_.body(node.callee);
      put("@");
      name(callee.name);
      return calleeOperands(callee, node.operands);
    }
  }
}

}  // namespace rung::ir::text_form
