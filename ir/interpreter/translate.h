// SPDX-License-Identifier: Apache-2.0
// IR to the compact form (code.h). In: a verified module after its passes, where the blocks of memory are, and the
// available native functions. Out: code, or the name of a native function that is missing. Called by program.cpp.
// Coverage and traced calls are instructions that exist only on request; for coverage the IR is translated before any
// pass.
#pragma once

#include <span>
#include <vector>

#include "ir/interpreter/recorded_code.h"
#include "ir/walk.h"

namespace rung::ir::interpreter {

// Tells whether an expression or something below it is of that kind.
inline bool contains(const Body& body, ExprId root, ExprKind kind) {
  bool found = false;
  forEachExpr(body, root, [&](ExprId at) { found = found || body.expr(at).kind == kind; });
  return found;
}
inline bool isImage(const Body& body, ExprId place) { return body.expr(rootOf(body, place)).kind == ExprKind::Image; }

class BodyTranslator : RecordedCode {
 public:
  BodyTranslator(const Module& module, const MemoryBlocks& blocks, StringPool& pool, const TranslateOptions& options,
                 Code& code)
      : RecordedCode(module, pool, options, code), blocks_(blocks) {}

  void translate(BodyId id);
  // Code that an entry of the module runs: calls of initialisers, bodies and functions, then Halt.
  struct Step {
    enum Kind : uint8_t { Clear, CallOn, CallOnSelf, CallOf } kind;
    BodyId body;
    uint32_t block = 0;
  };
  Code::Entry translateSteps(std::span<const Step> steps);
  // Null, and its name in Code::missing, when it is not available.
  NativeThunk findNative(const Body& callee);

 private:
  // An element of an array of scalars, for instructions that take the base and the last index.
  struct Element {
    Address base;  // of the lowest index, without an offset from a pointer
    Operand index;
    Scalar index_type = Scalar::I64;
    int64_t range = 0;  // as instructions read it: lowest index, count
    uint32_t site = 0;
  };

  // ---- translate.cpp: the body and its frame
  void begin();
  void layOutLocals();
  void loadBases();
  void clearVariables();

  // ---- expressions.cpp
  Operand value(ExprId id, const Operand* want = nullptr);
  Operand load(ExprId id, const Operand* want);
  void valueInto(ExprId id, const Operand& to);
  Operand constant(const Expr& e) const;
  Operand unary(const Expr& e, const Operand* want);
  Operand binary(const Expr& e, const Operand* want);
  Operand comparison(const Expr& e, const Operand* want);
  std::pair<Operand, Operand> comparedValues(ExprId a, ExprId b, Op& op);
  Operand shift(const Expr& e, const Operand* want);
  Operand power(const Expr& e, const Operand* want);
  Operand select(const Expr& e, const Operand* want);
  Operand operate(Op op, Scalar type, Operand left, Operand right, const Operand* want, uint32_t site = 0);
  Operand convert(ExprId id, const Operand* want);
  void convertChecks(const Expr& e, const Operand& from);
  Operand converted(Operand from, Scalar source, Scalar target, const Operand* want);
  Operand whole(const Operand& from, Scalar type, bool saturates);
  Operand wide(const Operand& from, Scalar type);  // as I64 or U64
  Operand wideBits(ExprId id);                     // for the runtime's functions, in the frame
  void branch(ExprId condition, bool sense, Label to);

  // ---- places.cpp
  using FrameCode::place;  // a label
  Address place(ExprId id);
  Address fieldMemory(const Expr& e);  // of a by-reference field: of the pointer itself
  Address fieldPlace(const Expr& e);
  Address blockMemory(uint32_t block) const;
  Address imageMemory(const ImageExpr& image) const;
  Address bitsPlace(const Expr& e);
  Address selectedPlace(const Expr& e);
  void checkNull(const Operand& pointer, uint32_t fault, Loc loc);
  Address indexed(const Expr& e, size_t count);
  uint32_t indexSite(const Expr& e, const types::Dimension& dimension);  // 0 where it is not checked
  bool loadOfTwo(ExprId id, const Operand* want, Operand& to);           // a[i, j] by one instruction
  bool element(const Expr& e, Element& out);                             // false: not of that kind, nothing emitted
  Operand indexOperand(ExprId id, Scalar& type);

  // ---- strings.cpp
  Address string(ExprId id);
  void assignString(const Address& to, uint32_t capacity, bool wide, ExprId from);
  void copyString(const Address& to, uint32_t capacity, bool wide, const Address& from, TypeId type);
  Operand stringOrder(ExprId left, ExprId right);
  Address literal(const Expr& e);
  Address stringBuffer(TypeId type);

  // ---- statements.cpp
  void block(StmtId first);
  void statement(const Stmt& stmt);
  Loc beginOf(const Stmt& stmt) const;
  void assign(ExprId to, ExprId from);
  void bindStatement(const BindStmt& stmt);
  void ifStatement(const IfStmt& stmt, Loc loc);
  void faultStatement(const FaultStmt& stmt, Loc loc);
  void evaluate(ExprId id);
  struct SwitchRow {
    uint64_t low, high;  // as unsigned numbers of the same order
    Label label;
  };
  void switchStatement(const SwitchStmt& stmt, Loc loc);
  void switchByTable(const Operand& value, Scalar type, const std::vector<SwitchRow>& rows, Label otherwise);
  void switchByRanges(const Operand& value, Scalar type, const std::vector<SwitchRow>& rows, Label otherwise);
  void loopStatement(const LoopStmt& stmt);
  void forStatement(const ForStmt& stmt);
  void tryStatement(const TryStmt& stmt);
  void leaveTo(Label label, uint32_t try_depth);
  void assertStatement(const Stmt& stmt);
  void noteLabels(StmtId first, uint32_t depth);

  // ---- calls.cpp
  void callStatement(const CallStmt& stmt, Loc loc);
  Operand callExpression(const Expr& e, const Operand* want);
  Address callString(const Expr& e);
  Ref passOperands(const CallExpr& call);
  struct Argument {
    const Local* parameter;
    ExprId operand;
    Ref to;
    bool copied = false;
    Address copy;
  };
  bool canHoldResult(const CallStmt& stmt, const Body& callee, const std::vector<Argument>& passed) const;
  void emitCallOf(const CallStmt& stmt, const Address& self, size_t passed, Loc loc);
  void storeResult(ExprId to, Ref result);
  void copyBack(const std::vector<Argument>& passed);
  std::vector<Argument> arguments(const Body& callee, Slice<ExprId> operands, uint32_t at);
  void passArguments(std::vector<Argument>& arguments);
  void passArgument(Argument& argument, Ref to);
  void emitVirtualCall(BodyId method, const Address& self, uint32_t site);
  void emitCall(BodyId callee, const Address* self, uint32_t site);

  const MemoryBlocks& blocks_;

  std::vector<uint32_t> local_offset_;
  Ref result_slot_;
  std::vector<std::pair<uint32_t, Ref>> block_slots_, image_slots_;
  // Where break, continue, return and jumps go; out of a try in steps.
  struct Loop {
    Label on_break, on_continue;
    uint32_t try_depth;
  };
  std::vector<Loop> loops_;
  struct Exit {
    Label to;
    uint32_t try_depth;
  };
  struct Try {
    Operand exit;
    std::vector<Exit> exits;
  };
  std::vector<Try> tries_;
  Label return_label_ = 0;
  struct UserLabel {
    Label label = 0;
    uint32_t try_depth = 0;
  };
  std::vector<UserLabel> user_labels_;
};

// The constant bytes of the module; before any body.
void translateData(const Module& module, Code& code);
// Gives each call the address of its callee; after everything is translated.
void translateDispatches(const Module& module, Code& code);
void link(const Module& module, Code& code);

}  // namespace rung::ir::interpreter
