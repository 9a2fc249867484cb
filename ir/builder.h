// SPDX-License-Identifier: Apache-2.0
// Builds expressions and statements of one body: the constructors that lowering, the reader of IR text and passes
// share. In: ids of operands already made. Out: ids in the body's pools. An expression is a tree: an id is used as
// operand once; `copy` makes a second one. Statements are appended to the open block:
//   Block outer = b.open();  b.assign(…);  StmtId then = b.close(outer);  b.ifElse(condition, then, {});
// `add` and `append` make a node of any kind from its fields; the other functions find its type and its list as well.
#pragma once

#include <initializer_list>
#include <span>

#include "ir/ir.h"

namespace rung::ir {

// A list of statements under construction.
struct Block {
  StmtId first, last;
};

class Builder {
 public:
  Builder(Module& module, Body& body) : module(module), body(body) {}
  Module& module;
  Body& body;
  Loc loc;  // of what is made next, unless `add` or `append` is given another

  // ---- any node
  template <class T>
  ExprId add(Loc at, TypeId type, const T& fields, uint8_t checks = 0) {
    Expr expr;
    expr.checks = checks;
    expr.type = type;
    expr.loc = at;
    expr.set(fields);
    attachOperands(fields);
    return push(expr);
  }
  template <class T>
  StmtId append(Loc at, const T& fields) {
    Stmt stmt;
    stmt.loc = at;
    stmt.set(fields);
    attachOperands(fields);
    return push(stmt);
  }
  template <class T>
  StmtId append(const T& fields) {
    return append(loc, fields);
  }
  Slice<ExprId> list(std::span<const ExprId> operands);
  // Of a node that gives its operand away: the operand may be used once more.
  void detach(ExprId operand) {
    if (operand.index < attached_.size()) attached_[operand.index] = false;
  }

  // ---- variables of the body
  uint32_t local(NameId name, TypeId type, LocalKind kind);  // by_reference follows from kind and type
  uint32_t temp(TypeId type);                                // `t1`, `t2`, …
  uint32_t label(NameId name);                               // its number

  // ---- constants
  ExprId constant(TypeId type, uint64_t bits);
  ExprId constant(const types::Value& value);  // scalar or string
  ExprId boolean(bool value) { return constant(types::kBool, value); }
  ExprId integer(TypeId type, int64_t value) { return constant(type, static_cast<uint64_t>(value)); }
  ExprId real(TypeId type, double value) { return constant(types::Value::ofReal(type, value)); }
  ExprId string(TypeId type, NameId characters);
  ExprId data(uint32_t index);  // of Module::data
  ExprId zero(TypeId type);

  // ---- places
  ExprId localPlace(uint32_t local);
  ExprId self();
  ExprId global(uint32_t list);
  ExprId program(uint32_t instance);
  ExprId image(TypeId type, uint32_t area, uint32_t byte, uint32_t bit = kNoBit);
  ExprId field(ExprId base, uint32_t index, uint8_t checks = 0);
  ExprId index(ExprId base, std::span<const ExprId> indices, uint8_t checks = 0);
  ExprId index(ExprId base, ExprId one, uint8_t checks = 0) { return index(base, {&one, 1}, checks); }
  ExprId deref(ExprId pointer, uint8_t checks = 0);
  ExprId bits(ExprId base, TypeId part, uint32_t position);  // part: BOOL, BYTE, WORD or DWORD

  // ---- values
  ExprId unary(Op op, ExprId a, uint8_t checks = 0);
  ExprId binary(Op op, ExprId a, ExprId b, uint8_t checks = 0);  // a comparison is BOOL, else of a's plain type
  ExprId convert(TypeId to, ExprId a, uint8_t checks = 0, types::Rounding rounding = types::Rounding::ToEven);
  ExprId select(ExprId condition, ExprId yes, ExprId no);
  ExprId call(BodyId function, std::span<const ExprId> operands);
  ExprId address(TypeId pointer, ExprId place);
  ExprId negation(ExprId condition);  // NOT of a BOOL; removes a double NOT
  ExprId copy(ExprId expr);           // the whole tree

  // ---- blocks
  Block open() {
    Block outer = block_;
    block_ = {};
    return outer;
  }
  StmtId close(Block outer) {
    StmtId first = block_.first;
    block_ = outer;
    return first;
  }
  Block& block() { return block_; }

  // ---- statements, appended to the open block
  StmtId assign(ExprId place, ExprId value);
  StmtId bind(ExprId field, ExprId place) { return append(BindStmt{field, place}); }
  StmtId callStmt(BodyId callee, ExprId self, std::span<const ExprId> operands, ExprId result = {});
  StmtId ifElse(ExprId condition, StmtId then_block, StmtId else_block = {});
  StmtId switchStmt(ExprId selector, std::span<const Case> cases, StmtId else_block = {});
  StmtId loop(StmtId body_block, StmtId next_block = {});
  StmtId forLoop(ExprId control, ExprId from, ExprId to, ExprId step, StmtId body_block);
  StmtId breakLoop() { return append(BreakStmt{}); }
  StmtId continueLoop() { return append(ContinueStmt{}); }
  StmtId returnBody() { return append(ReturnStmt{}); }
  StmtId jump(uint32_t label) { return append(JumpStmt{label}); }
  StmtId placeLabel(uint32_t label);
  StmtId fault(types::Fault fault, ExprId value = {});
  StmtId assertion(Assertion kind, ExprId a, ExprId b, ExprId c, NameId text, NameId shown = {});
  StmtId evaluate(ExprId expr) { return append(EvaluateStmt{expr}); }
  // A case of a switch: its ranges go to the body's pool. Collect the results and pass all of them to switchStmt.
  Case makeCase(std::span<const CaseRange> ranges, StmtId block);

 private:
  template <class T>
  ExprId add(TypeId type, const T& fields, uint8_t checks = 0) {
    return add(loc, strip(type), fields, checks);
  }
  ExprId push(const Expr& expr) {
    if (body.exprs.empty()) body.exprs.emplace_back();
    body.exprs.push_back(expr);
    return ExprId{static_cast<uint32_t>(body.exprs.size()) - 1};
  }
  StmtId push(const Stmt& stmt);

  // Notes that the operands of a node have a user now.
  void attach(ExprId operand) {
    if (!operand) return;
    if (attached_.size() <= operand.index) attached_.resize(body.exprs.size() + 64);
    RUNG_INVARIANT(!attached_[operand.index], "an expression is the operand of one node; a second one takes a copy");
    attached_[operand.index] = true;
  }
#define RUNG_OPERAND(name) attach(node.name);
#define RUNG_READ(name) attach(node.name);
#define RUNG_WRITE(name) attach(node.name);
#define RUNG_REFERENCE(name) attach(node.name);
#define RUNG_OPERANDS(name)  // `list` has attached those in a list
#define RUNG_ARGUMENTS(name)
#define RUNG_BLOCK(name)
#define RUNG_CASES(name)
#define RUNG_VALUE(type, name)
#define RUNG_EXPR(kind, word, role, checks, fields) \
  void attachOperands([[maybe_unused]] const kind##Expr& node) { fields }
#define RUNG_STMT(kind, word, effect, flow, fields) \
  void attachOperands([[maybe_unused]] const kind##Stmt& node) { fields }
#include "ir/instructions.def"
#undef RUNG_OPERAND
#undef RUNG_OPERANDS
#undef RUNG_READ
#undef RUNG_WRITE
#undef RUNG_REFERENCE
#undef RUNG_ARGUMENTS
#undef RUNG_BLOCK
#undef RUNG_CASES
#undef RUNG_VALUE

  TypeId strip(TypeId type) const { return module.types.resolve(type); }
  Block block_;
  std::vector<uint8_t> attached_;  // by expression: whether this builder made it an operand
  uint32_t temps_ = 0;
};

// Tells whether a variable of this kind and type is passed by reference (Local::by_reference).
bool isPassedByReference(const types::TypeTable& types, LocalKind kind, TypeId type);
// Arrays, records and strings: copied whole, passed by reference.
bool isAggregate(const types::TypeTable& types, TypeId type);

}  // namespace rung::ir
