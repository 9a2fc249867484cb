// SPDX-License-Identifier: Apache-2.0
// The constructors of IR nodes: see builder.h.
#include <cstdio>

#include "frontend/source/invariant.h"
#include "frontend/source/text.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

// A row is RUNG_PLACE where its role is that of a place.
#define RUNG_EXPR(kind, word, role, checks, fields) static_assert(!isPlace(ExprKind::kind));
#define RUNG_PLACE(kind, word, role, checks, fields) static_assert(isPlace(ExprKind::kind));
#include "ir/instructions.def"

bool isAggregate(const TypeTable& types, TypeId type) {
  TypeKind kind = types.kind(type);
  return kind == TypeKind::Array || kind == TypeKind::Record || TypeTable::isString(kind);
}

bool isPassedByReference(const TypeTable& types, LocalKind kind, TypeId type) {
  switch (kind) {
    case LocalKind::Temp:
    case LocalKind::Variable: return false;
    case LocalKind::Output:
    case LocalKind::InOut: return true;
    case LocalKind::Input:
    case LocalKind::Result: return isAggregate(types, type);
  }
  return false;
}

// ---- variables

uint32_t Builder::local(NameId name, TypeId type, LocalKind kind) {
  Local local;
  local.name = name;
  local.type = strip(type);
  local.kind = kind;
  local.by_reference = isPassedByReference(module.types, kind, type);
  local.loc = loc;
  body.locals.push_back(local);
  return static_cast<uint32_t>(body.locals.size()) - 1;
}

uint32_t Builder::temp(TypeId type) {
  if (temps_ == 0) {  // a body may be taken up again by another builder
    for (const Local& local : body.locals) temps_ += local.kind == LocalKind::Temp;
  }
  char name[16];
  int length = std::snprintf(name, sizeof name, "t%u", ++temps_);
  return local(module.names.intern({name, static_cast<size_t>(length)}), type, LocalKind::Temp);
}

uint32_t Builder::label(NameId name) {
  body.has_labels = true;
  body.labels.push_back(name);
  return static_cast<uint32_t>(body.labels.size()) - 1;
}

// ---- expressions

Slice<ExprId> Builder::list(std::span<const ExprId> operands) {
  for (const ExprId operand : operands) attach(operand);
  const auto first = static_cast<uint32_t>(body.operands.size());
  body.operands.insert(body.operands.end(), operands.begin(), operands.end());
  return {first, static_cast<uint32_t>(operands.size())};
}

ExprId Builder::constant(TypeId type, uint64_t bits) { return add(type, ConstExpr{.bits = bits}); }

ExprId Builder::constant(const types::Value& value) {
  if (TypeTable::isString(module.types.kind(value.type)))
    return string(value.type, NameId{static_cast<uint32_t>(value.bits)});
  return constant(value.type, value.bits);
}

ExprId Builder::string(TypeId type, NameId characters) { return add(type, StringExpr{characters}); }

ExprId Builder::data(uint32_t index) { return add(module.data[index].type, DataExpr{index}); }

ExprId Builder::zero(TypeId type) { return add(type, ZeroExpr{}); }

ExprId Builder::localPlace(uint32_t index) { return add(body.locals[index].type, LocalExpr{index}); }

ExprId Builder::self() { return add(body.self, SelfExpr{}); }

ExprId Builder::global(uint32_t list) { return add(module.lists[list].record, GlobalExpr{list}); }

ExprId Builder::program(uint32_t instance) { return add(module.programs[instance].record, ProgramExpr{instance}); }

ExprId Builder::image(TypeId type, uint32_t area, uint32_t byte, uint32_t bit) {
  return add(type, ImageExpr{area, byte, bit});
}

ExprId Builder::field(ExprId base, uint32_t index, uint8_t checks) {
  const TypeInfo& record = module.types.info(strip(body.expr(base).type));
  RUNG_INVARIANT(index < record.fields.size(), "a field place names a field of its record");
  return add(record.fields[index].type, FieldExpr{base, index}, checks);
}

ExprId Builder::index(ExprId base, std::span<const ExprId> indices, uint8_t checks) {
  const TypeId element = module.types.info(strip(body.expr(base).type)).base;
  return add(element, IndexExpr{base, list(indices)}, checks);
}

ExprId Builder::deref(ExprId pointer, uint8_t checks) {
  return add(module.types.info(strip(body.expr(pointer).type)).base, DerefExpr{pointer}, checks);
}

ExprId Builder::bits(ExprId base, TypeId part, uint32_t position) { return add(part, BitsExpr{base, position}); }

ExprId Builder::unary(Op op, ExprId a, uint8_t checks) {
  return add(loc, module.types.plain(body.expr(a).type), UnaryExpr{a, op}, checks);
}

ExprId Builder::binary(Op op, ExprId a, ExprId b, uint8_t checks) {
  const TypeId type = types::isComparison(op) ? types::kBool : module.types.plain(body.expr(a).type);
  return add(loc, type, BinaryExpr{a, b, op}, checks);
}

ExprId Builder::convert(TypeId to, ExprId a, uint8_t checks, types::Rounding rounding) {
  return add(to, ConvertExpr{a, rounding}, checks);
}

ExprId Builder::select(ExprId condition, ExprId yes, ExprId no) {
  return add(loc, body.expr(yes).type, SelectExpr{condition, yes, no});
}

ExprId Builder::call(BodyId function, std::span<const ExprId> operands) {
  return add(module.body(function).result, CallExpr{function, list(operands)});
}

ExprId Builder::address(TypeId pointer, ExprId place) { return add(pointer, AddressExpr{place}); }

ExprId Builder::negation(ExprId condition) {
  const auto* inverse = body.expr(condition).tryAs<UnaryExpr>();
  if (inverse != nullptr && inverse->op == Op::Not) {
    detach(inverse->operand);
    return inverse->operand;
  }
  return unary(Op::Not, condition);
}

ExprId Builder::copy(ExprId original) {
  Expr expr = body.expr(original);
  auto copyList = [&](Slice<ExprId>& operands) {
    std::vector<ExprId> copies;
    copies.reserve(operands.count);
    for (uint32_t i = 0; i < operands.count; ++i)
      copies.push_back(copy(body.list(operands)[i]));  // the pool may move meanwhile
    operands = list(copies);
  };
  if (expr.kind == ExprKind::Index) {
    copyList(expr.as<IndexExpr>().indices);
    expr.as<IndexExpr>().base = copy(expr.as<IndexExpr>().base);
  } else if (expr.kind == ExprKind::Call) {
    copyList(expr.as<CallExpr>().operands);
  } else {
    forEachOperand(body, expr, [&](ExprId& operand) { operand = copy(operand); });
  }
  switch (expr.kind) {
#define RUNG_EXPR(kind, word, role, checks, fields) \
  case ExprKind::kind:                              \
    attachOperands(expr.as<kind##Expr>());          \
    break;
#include "ir/instructions.def"
  }
  return push(expr);
}

// ---- statements

StmtId Builder::push(const Stmt& stmt) {
  if (body.stmts.empty()) body.stmts.emplace_back();
  body.stmts.push_back(stmt);
  StmtId id{static_cast<uint32_t>(body.stmts.size()) - 1};
  if (block_.last) body.stmt(block_.last).next = id;
  if (!block_.first) block_.first = id;
  block_.last = id;
  return id;
}

StmtId Builder::assign(ExprId place, ExprId value) { return append(AssignStmt{place, value}); }

StmtId Builder::callStmt(BodyId callee, ExprId self, std::span<const ExprId> operands, ExprId result) {
  return append(CallStmt{.callee = callee, .self = self, .operands = list(operands), .result = result});
}

StmtId Builder::ifElse(ExprId condition, StmtId then_block, StmtId else_block) {
  return append(IfStmt{condition, then_block, else_block});
}

StmtId Builder::switchStmt(ExprId selector, std::span<const Case> cases, StmtId else_block) {
  const auto first = static_cast<uint32_t>(body.cases.size());
  body.cases.insert(body.cases.end(), cases.begin(), cases.end());
  return append(SwitchStmt{selector, {first, static_cast<uint32_t>(cases.size())}, else_block});
}

Case Builder::makeCase(std::span<const CaseRange> ranges, StmtId block) {
  const auto first = static_cast<uint32_t>(body.ranges.size());
  body.ranges.insert(body.ranges.end(), ranges.begin(), ranges.end());
  return {{first, static_cast<uint32_t>(ranges.size())}, block};
}

StmtId Builder::loop(StmtId body_block, StmtId next_block) { return append(LoopStmt{body_block, next_block}); }

StmtId Builder::forLoop(ExprId control, ExprId from, ExprId to, ExprId step, StmtId body_block) {
  return append(ForStmt{control, from, to, step, body_block});
}

StmtId Builder::placeLabel(uint32_t label) {
  body.has_labels = true;
  return append(LabelStmt{label});
}

StmtId Builder::fault(types::Fault fault, ExprId value) { return append(FaultStmt{value, fault}); }

std::string nativePrefix(std::string_view library) {
  std::string out = "rung_";
  for (const char c : library.empty() ? "project" : library) out += foldedCharacter(c);
  return out;
}

std::string nativeName(const Module& module, const Body& body) {
  const std::string_view library = module.names.string(body.library_name);
  std::string_view name = module.names.string(body.name);
  std::string out = nativePrefix(library) + '_';
  // A function that a user's one hides is `Standard__MID`: the C function has its plain name.
  if (name.size() > library.size() + 2 && name.substr(0, library.size()) == library &&
      name.substr(library.size(), 2) == "__") {
    name.remove_prefix(library.size() + 2);
  }
  out += name;
  return out;
}

}  // namespace rung::ir
