// The constructors of IR nodes: see builder.h.
#include <cstdio>

#include "frontend/source/invariant.h"
#include "ir/builder.h"
#include "ir/walk.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;

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

bool isPlace(ExprKind kind) { return kind >= ExprKind::Local && kind <= ExprKind::Bits; }

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

ExprId Builder::add(ExprKind kind, TypeId type, uint32_t a, uint32_t b, uint32_t c, uint8_t checks) {
  if (body.exprs.empty()) body.exprs.emplace_back();
  Expr expr;
  expr.kind = kind;
  expr.type = type;
  expr.loc = loc;
  expr.checks = checks;
  expr.a = a;
  expr.b = b;
  expr.c = c;
  body.exprs.push_back(expr);
  return ExprId{static_cast<uint32_t>(body.exprs.size()) - 1};
}

ExprId Builder::constant(TypeId type, uint64_t bits) {
  return add(ExprKind::Const, strip(type), static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32));
}

ExprId Builder::constant(const types::Value& value) {
  if (TypeTable::isString(module.types.kind(value.type)))
    return string(value.type, NameId{static_cast<uint32_t>(value.bits)});
  return constant(value.type, value.bits);
}

ExprId Builder::string(TypeId type, NameId characters) { return add(ExprKind::String, strip(type), characters.index); }

ExprId Builder::data(uint32_t index) { return add(ExprKind::Data, strip(module.data[index].type), index); }

ExprId Builder::zero(TypeId type) { return add(ExprKind::Zero, strip(type)); }

ExprId Builder::localPlace(uint32_t index) { return add(ExprKind::Local, strip(body.locals[index].type), index); }

ExprId Builder::self() { return add(ExprKind::Self, strip(body.self)); }

ExprId Builder::global(uint32_t list) { return add(ExprKind::Global, strip(module.lists[list].record), list); }

ExprId Builder::program(uint32_t instance) {
  return add(ExprKind::Program, strip(module.programs[instance].record), instance);
}

ExprId Builder::image(TypeId type, uint32_t area, uint32_t byte, uint32_t bit) {
  return add(ExprKind::Image, strip(type), area, byte, bit);
}

ExprId Builder::field(ExprId base, uint32_t index, uint8_t checks) {
  const TypeInfo& record = module.types.info(strip(body.expr(base).type));
  RUNG_INVARIANT(index < record.fields.size(), "a field place names a field of its record");
  return add(ExprKind::Field, strip(record.fields[index].type), base.index, index, 0, checks);
}

ExprId Builder::index(ExprId base, std::span<const ExprId> indices, uint8_t checks) {
  TypeId element = strip(module.types.info(strip(body.expr(base).type)).base);
  uint32_t first = static_cast<uint32_t>(body.operands.size());
  body.operands.insert(body.operands.end(), indices.begin(), indices.end());
  return add(ExprKind::Index, element, base.index, first, static_cast<uint32_t>(indices.size()), checks);
}

ExprId Builder::deref(ExprId pointer, uint8_t checks) {
  TypeId target = strip(module.types.info(strip(body.expr(pointer).type)).base);
  return add(ExprKind::Deref, target, pointer.index, 0, 0, checks);
}

ExprId Builder::bits(ExprId base, TypeId part, uint32_t position) {
  return add(ExprKind::Bits, strip(part), base.index, position);
}

ExprId Builder::unary(Op op, ExprId a, uint8_t checks) {
  ExprId id = add(ExprKind::Unary, module.types.plain(body.expr(a).type), a.index, 0, 0, checks);
  body.expr(id).op = op;
  return id;
}

ExprId Builder::binary(Op op, ExprId a, ExprId b, uint8_t checks) {
  TypeId type = types::isComparison(op) ? types::kBool : module.types.plain(body.expr(a).type);
  ExprId id = add(ExprKind::Binary, type, a.index, b.index, 0, checks);
  body.expr(id).op = op;
  return id;
}

ExprId Builder::convert(TypeId to, ExprId a, uint8_t checks) {
  return add(ExprKind::Convert, strip(to), a.index, 0, 0, checks);
}

ExprId Builder::select(ExprId condition, ExprId yes, ExprId no) {
  return add(ExprKind::Select, body.expr(yes).type, condition.index, yes.index, no.index);
}

ExprId Builder::call(BodyId function, std::span<const ExprId> operands) {
  uint32_t first = static_cast<uint32_t>(body.operands.size());
  body.operands.insert(body.operands.end(), operands.begin(), operands.end());
  return add(ExprKind::Call, strip(module.body(function).result), function.index, first,
             static_cast<uint32_t>(operands.size()));
}

ExprId Builder::address(TypeId pointer, ExprId place) { return add(ExprKind::Address, strip(pointer), place.index); }

ExprId Builder::negation(ExprId condition) {
  const Expr& expr = body.expr(condition);
  if (expr.kind == ExprKind::Unary && expr.op == Op::Not) return ExprId{expr.a};
  return unary(Op::Not, condition);
}

ExprId Builder::copy(ExprId original) {
  Expr expr = body.expr(original);
  if (expr.kind == ExprKind::Index || expr.kind == ExprKind::Call) {  // operands in a separate slice
    uint32_t first = static_cast<uint32_t>(body.operands.size());
    body.operands.resize(first + expr.c);
    for (uint32_t i = 0; i < expr.c; ++i) {
      ExprId operand = copy(body.operands[expr.b + i]);  // may move the pool
      body.operands[first + i] = operand;
    }
    expr.b = first;
    if (expr.kind == ExprKind::Index) expr.a = copy(ExprId{expr.a}).index;
  } else {
    forEachSlot(body, expr, [&](uint32_t& slot) { slot = copy(ExprId{slot}).index; });
  }
  body.exprs.push_back(expr);
  return ExprId{static_cast<uint32_t>(body.exprs.size()) - 1};
}

// ---- statements

StmtId Builder::append(StmtKind kind, uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t e) {
  if (body.stmts.empty()) body.stmts.emplace_back();
  Stmt stmt;
  stmt.kind = kind;
  stmt.loc = loc;
  stmt.a = a;
  stmt.b = b;
  stmt.c = c;
  stmt.d = d;
  stmt.e = e;
  body.stmts.push_back(stmt);
  StmtId id{static_cast<uint32_t>(body.stmts.size()) - 1};
  if (block_.last) body.stmt(block_.last).next = id;
  if (!block_.first) block_.first = id;
  block_.last = id;
  return id;
}

StmtId Builder::assign(ExprId place, ExprId value) { return append(StmtKind::Assign, place.index, value.index); }

StmtId Builder::callStmt(BodyId callee, ExprId self, std::span<const ExprId> operands, ExprId result) {
  uint32_t first = static_cast<uint32_t>(body.operands.size());
  body.operands.insert(body.operands.end(), operands.begin(), operands.end());
  return append(StmtKind::Call, callee.index, self.index, first, static_cast<uint32_t>(operands.size()), result.index);
}

StmtId Builder::ifElse(ExprId condition, StmtId then_block, StmtId else_block) {
  return append(StmtKind::If, condition.index, then_block.index, else_block.index);
}

StmtId Builder::switchStmt(ExprId selector, std::span<const Case> cases, StmtId else_block) {
  uint32_t first = static_cast<uint32_t>(body.cases.size());
  body.cases.insert(body.cases.end(), cases.begin(), cases.end());
  return append(StmtKind::Switch, selector.index, first, static_cast<uint32_t>(cases.size()), else_block.index);
}

Case Builder::makeCase(std::span<const CaseRange> ranges, StmtId block) {
  uint32_t first = static_cast<uint32_t>(body.ranges.size());
  body.ranges.insert(body.ranges.end(), ranges.begin(), ranges.end());
  return {first, static_cast<uint32_t>(ranges.size()), block};
}

StmtId Builder::loop(StmtId body_block, StmtId next_block) {
  return append(StmtKind::Loop, body_block.index, next_block.index);
}

StmtId Builder::forLoop(ExprId control, ExprId from, ExprId to, ExprId step, StmtId body_block) {
  return append(StmtKind::For, control.index, from.index, to.index, step.index, body_block.index);
}

StmtId Builder::placeLabel(uint32_t label) {
  body.has_labels = true;
  return append(StmtKind::Label, label);
}

StmtId Builder::tryCatch(StmtId body_block, StmtId catch_block, StmtId finally_block, ExprId number) {
  return append(StmtKind::Try, body_block.index, catch_block.index, finally_block.index, number.index);
}

StmtId Builder::fault(types::Fault fault, ExprId value) {
  StmtId id = append(StmtKind::Fault, value.index);
  body.stmt(id).op = static_cast<uint8_t>(fault);
  return id;
}

StmtId Builder::assertion(Assertion kind, ExprId a, ExprId b, ExprId c, NameId text, NameId shown) {
  StmtId id = append(StmtKind::Assert, a.index, b.index, c.index, text.index, shown.index);
  body.stmt(id).op = static_cast<uint8_t>(kind);
  return id;
}

std::string nativeName(const Module& module, const Body& body) {
  const std::string_view library = module.names.string(body.library_name);
  std::string_view name = module.names.string(body.name);
  std::string out = "rung_";
  for (char c : library) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  out += '_';
  // A function that a user's one hides is `Standard__MID`: the C function has its plain name.
  if (name.size() > library.size() + 2 && name.substr(0, library.size()) == library &&
      name.substr(library.size(), 2) == "__") {
    name.remove_prefix(library.size() + 2);
  }
  out += name;
  return out;
}

}  // namespace rung::ir
