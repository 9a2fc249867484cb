// IR to the compact form (code.h). In: a verified module after its passes, where the blocks of memory are, and the
// available native functions. Out: code, or the name of a native function that is missing. Called by program.cpp.
// Coverage and traced calls are instructions that exist only on request; for coverage the IR is translated before any
// pass.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "ir/description.h"
#include "ir/interpreter/code.h"
#include "ir/interpreter/handlers.h"
#include "ir/ir.h"

namespace rung::ir::interpreter {

// The code of a module; nothing in it refers to the IR.
struct Code {
  struct Entry {
    uint32_t at = 0;     // index of its first instruction
    uint32_t frame = 0;  // bytes that its frame needs, what natives get included
  };
  std::vector<Insn> insns;
  std::vector<Entry> bodies;  // by BodyId
  std::vector<rung_site> sites;
  // Where each statement begins, for faults without a check: the instruction and the source location. Sorted.
  struct LineEntry {
    uint32_t insn, pou, file, line, column;  // strings as in rung_site
  };
  std::vector<LineEntry> line_table;
  // Memory that instructions point to; deques do not move it.
  std::deque<std::string> strings;
  std::deque<std::u16string> wide_strings;
  std::deque<std::vector<uint64_t>> data;  // constant bytes, aligned
  std::deque<std::vector<int32_t>> tables;
  std::deque<std::vector<SwitchRange>> ranges;
  std::deque<AssertionSite> assertions;
  std::deque<Counter> counters;
  std::vector<const char*> called;                    // by BodyId: the name that traced calls give, or null
  std::vector<const uint64_t*> data_of_module;        // by index of Module::data
  std::vector<std::vector<VirtualEntry>> dispatches;  // as Module::dispatches
  std::deque<VirtualCall> virtual_calls;
  std::vector<std::pair<uint32_t, BodyId>> calls;  // instructions that need the address of a body
  std::string missing;  // a native function that is not available, by its name in the library; else empty
};

struct TranslateOptions {
  std::span<const Native> natives;  // sorted by name
  bool bounded = false;             // count iterations and calls (Machine::budget)
  bool coverage = false;            // count how often lines run (Code::counters)
  bool trace_calls = false;         // report each call of a POU to the host
};

// An operand or address: an offset, in the frame or in the frame that a callee is going to have.
struct Ref {
  uint32_t offset = 0;
  bool outgoing = false;
  friend bool operator==(const Ref&, const Ref&) = default;
};
struct Operand {
  Mode mode = Mode::Constant;
  Ref ref;
  int64_t imm = 0;
  friend bool operator==(const Operand&, const Operand&) = default;
};
struct Address {
  Base base = Base::Frame;
  Ref ref;              // Frame, Self: the memory; Pointer: the slot that holds the address
  uint32_t offset = 0;  // Pointer, Constant: bytes after it
  int64_t imm = 0;
  uint32_t bit = kNoBit;
};

class BodyTranslator {
 public:
  BodyTranslator(const Module& module, const MemoryBlocks& blocks, StringPool& pool, const TranslateOptions& options,
                 Code& code)
      : module_(module), types_(module.types), blocks_(blocks), pool_(pool), options_(options), code_(code) {}

  void translate(BodyId id);
  // Code that an entry of the module runs: calls of initialisers, bodies and functions, then Halt.
  struct Step {
    enum Kind : uint8_t { Clear, CallOn, CallOf } kind;
    BodyId body;
    uint32_t block = 0;
  };
  Code::Entry translateSteps(std::span<const Step> steps);
  // Null, and its name in Code::missing, when it is not available.
  NativeThunk findNative(const Body& callee);

 private:
  using Label = uint32_t;
  // An element of an array of scalars, for instructions that take the base and the last index.
  struct Element {
    Address base;  // of the lowest index, without an offset from a pointer
    Operand index;
    Scalar index_type = Scalar::I64;
    int64_t range = 0;  // as instructions read it: lowest index, count
    uint32_t site = 0;
  };

  // ---- translate.cpp: instructions, labels, frame
  uint32_t emit(Handler run, Ref a = {}, Ref b = {}, Ref c = {}, uint32_t d = 0, int64_t imm = 0);
  Label newLabel();
  void place(Label label);
  void jumpTo(uint32_t insn, Label label) { jumps_.push_back({insn, label}); }
  void jump(Label label);
  void begin();
  Code::Entry finish(uint32_t first);
  void layOutLocals();
  void loadBases();
  void clearVariables();
  Ref slot(uint64_t size = 8, uint32_t align = 8);
  Operand temp() { return {Mode::Frame, slot(), 0}; }
  uint32_t site(Loc loc, int64_t low = 0, int64_t high = 0);
  uint32_t headerSize(const Body& callee) const { return callee.native ? 0 : kFrameHeader; }

  // ---- expressions.cpp
  Operand value(ExprId id, const Operand* want = nullptr);
  void valueInto(ExprId id, const Operand& to);
  void move(Scalar type, const Operand& from, const Operand& to);
  Operand inFrame(const Operand& from, Scalar type);
  Operand inMemory(const Operand& from, Scalar type) {
    return from.mode == Mode::Constant ? inFrame(from, type) : from;
  }
  Operand target(const Operand* want) { return want != nullptr ? *want : temp(); }
  Operand constant(const Expr& e) const;
  Operand unary(const Expr& e, const Operand* want);
  Operand binary(const Expr& e, const Operand* want);
  Operand comparison(const Expr& e, const Operand* want);
  Operand shift(const Expr& e, const Operand* want);
  Operand power(const Expr& e, const Operand* want);
  Operand select(const Expr& e, const Operand* want);
  Operand operate(Op op, Scalar type, Operand left, Operand right, const Operand* want, uint32_t site = 0);
  Operand convert(ExprId id, const Operand* want);
  void convertChecks(const Expr& e, const Operand& from);
  Operand converted(Operand from, Scalar source, Scalar target, const Operand* want);
  Operand wide(const Operand& from, Scalar type);  // as I64 or U64
  Operand wideBits(ExprId id);                     // for the runtime's functions, in the frame
  void branch(ExprId condition, bool sense, Label to);
  bool mayFault(ExprId id) const;
  bool contains(ExprId id, ExprKind kind) const;
  bool touchesForeignMemory(ExprId id) const;  // memory that may not exist where nothing is checked

  // ---- places.cpp
  Address place(ExprId id);
  Address fieldMemory(const Expr& e);  // of a by-reference field: of the pointer itself
  Address indexed(const Expr& e, size_t count);
  uint32_t indexSite(const Expr& e, const types::Dimension& dimension);  // 0 where it is not checked
  bool loadOfTwo(ExprId id, const Operand* want, Operand& to);           // a[i, j] by one instruction
  bool element(const Expr& e, Element& out);                             // false: not of that kind, nothing emitted
  Operand indexOperand(ExprId id, Scalar& type);
  Operand read(const Address& from, Scalar type, const Operand* want);
  void write(const Address& to, Scalar type, const Operand& value);
  static bool isDirect(const Address& a) { return a.bit == kNoBit && (a.base == Base::Frame || a.base == Base::Self); }
  static Operand direct(const Address& a) { return {a.base == Base::Frame ? Mode::Frame : Mode::Self, a.ref, 0}; }
  static Address shifted(Address a, uint64_t bytes);
  Ref pointerTo(const Address& a);  // a slot that holds the address
  void pointerInto(const Address& a, Ref to);
  bool isImage(ExprId id) const;

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
  void assign(ExprId to, ExprId from);
  void copyAggregate(const Address& to, const Address& from, uint64_t size);
  void switchStatement(const SwitchStmt& stmt);
  void loopStatement(const LoopStmt& stmt);
  void forStatement(const ForStmt& stmt);
  void tryStatement(const TryStmt& stmt);
  void leaveTo(Label label, uint32_t try_depth);
  void assertStatement(const Stmt& stmt);
  ExprId exitTest(StmtId id) const;
  void noteLabels(StmtId first, uint32_t depth);

  void count(Loc loc, const char* function);
  void recordLocation(Loc loc);

  // ---- calls.cpp
  void traceCall(BodyId callee, const Address* self);
  void callStatement(const CallStmt& stmt, Loc loc);
  Operand callExpression(const Expr& e, const Operand* want);
  Address callString(const Expr& e);
  struct Argument {
    const Local* parameter;
    ExprId operand;
    Ref to;
    bool copied = false;
    Address copy;
  };
  std::vector<Argument> arguments(const Body& callee, Slice<ExprId> operands, uint32_t at);
  void passArguments(std::vector<Argument>& arguments);
  void passArgument(Argument& argument, Ref to);
  void emitVirtualCall(BodyId method, const Address& self, uint32_t site);
  void emitCall(BodyId callee, const Address* self, uint32_t site);

  // ---- small helpers
  const Expr& expr(ExprId id) const { return body_->expr(id); }
  types::TypeKind kindOf(ExprId id) const { return types_.plainKind(expr(id).type); }
  Scalar scalarOf(TypeId type) const;
  Scalar scalarOf(ExprId id) const { return scalarOf(expr(id).type); }
  bool isString(TypeId type) const { return types::TypeTable::isString(types_.kind(type)); }
  bool isWide(TypeId type) const { return types_.kind(type) == types::TypeKind::WString; }
  bool isAggregate(TypeId type) const {
    const types::TypeKind kind = types_.kind(type);
    return kind == types::TypeKind::Array || kind == types::TypeKind::Record;
  }
  const types::TypeInfo& info(TypeId type) const { return types_.info(types_.resolve(type)); }
  uint32_t capacityOf(TypeId type) const { return info(type).length; }

  const Module& module_;
  const types::TypeTable& types_;
  const MemoryBlocks& blocks_;
  StringPool& pool_;
  const TranslateOptions& options_;
  Code& code_;

  Loc recorded_loc_;  // the last one of code_.line_table
  const Body* body_ = nullptr;
  std::vector<uint32_t> local_offset_;
  Ref result_slot_;
  uint32_t top_ = 0, frame_ = 0;  // of temporaries now, and the most
  uint32_t native_slots_ = 0;     // the most bytes that a native function gets
  std::vector<std::pair<uint32_t, Ref>> block_slots_, image_slots_;
  struct Outgoing {
    uint32_t insn;
    uint8_t field;
  };
  std::vector<Outgoing> outgoing_;
  std::vector<uint32_t> labels_;  // position of each; ~0: not yet
  std::vector<std::pair<uint32_t, Label>> jumps_;
  struct TableJump {
    int32_t* to;
    uint32_t insn;
    Label label;
  };
  std::vector<TableJump> table_jumps_;

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
