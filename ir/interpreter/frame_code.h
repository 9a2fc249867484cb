// SPDX-License-Identifier: Apache-2.0
// The code of one body while it is made: instructions with labels and the frame of the body. Operands are where their
// values are; nothing is emitted that does not change something. In: handlers and operands. Out: Code. The base of
// BodyTranslator (translate.h), which walks the IR.
#pragma once

#include <deque>
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
  // For debuggers (TranslateOptions::debug), until DebugCode has them: where statements of the source begin, and by
  // BodyId the end of each body and where its locals are in the frame.
  struct Point {
    uint32_t insn, body, line, column, network;
    const char* file;
  };
  std::vector<Point> points;
  std::vector<uint32_t> debug_ends;
  std::vector<std::vector<uint32_t>> debug_offsets;
  std::vector<uint32_t> site_insns;  // by site: the next instruction when it was made
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

inline bool isDirect(const Address& a) { return a.bit == kNoBit && (a.base == Base::Frame || a.base == Base::Self); }
inline Operand direct(const Address& a) { return {a.base == Base::Frame ? Mode::Frame : Mode::Self, a.ref, 0}; }
// The address some bytes further.
Address shifted(Address a, uint64_t bytes);

class FrameCode {
 protected:
  FrameCode(const Module& module, StringPool& pool, Code& code)
      : module_(module), types_(module.types), pool_(pool), code_(code) {}
  using Label = uint32_t;

  // ---- instructions and labels
  void beginFrame();
  Code::Entry finishFrame(uint32_t first);
  uint32_t emit(Handler run, Ref a = {}, Ref b = {}, Ref c = {}, uint32_t d = 0, int64_t imm = 0);
  Label newLabel();
  void place(Label label);
  void jumpTo(uint32_t insn, Label label) { jumps_.push_back({insn, label}); }
  void jump(Label label);
  uint32_t site(Loc loc, int64_t low = 0, int64_t high = 0);

  // ---- the frame and operands
  Ref slot(uint64_t size = 8, uint32_t align = 8);
  Operand temp() { return {Mode::Frame, slot(), 0}; }
  Operand target(const Operand* want) { return want != nullptr ? *want : temp(); }
  void move(Scalar type, const Operand& from, const Operand& to);
  Operand inFrame(const Operand& from, Scalar type);
  Operand inMemory(const Operand& from, Scalar type) {
    return from.mode == Mode::Constant ? inFrame(from, type) : from;
  }
  Operand read(const Address& from, Scalar type, const Operand* want);
  void write(const Address& to, Scalar type, const Operand& value);
  Ref pointerTo(const Address& a);  // a slot that holds the address
  void pointerInto(const Address& a, Ref to);
  void copyAggregate(const Address& to, const Address& from, uint64_t size);

  // ---- types
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
  StringPool& pool_;
  Code& code_;
  const Body* body_ = nullptr;
  BodyId body_id_;                // none: an entry
  uint32_t top_ = 0, frame_ = 0;  // of temporaries now, and the most
  uint32_t native_slots_ = 0;     // the most bytes that a native function gets
  struct TableJump {
    int32_t* to;
    uint32_t insn;
    Label label;
  };
  std::vector<TableJump> table_jumps_;

 private:
  struct Outgoing {
    uint32_t insn;
    uint8_t field;
  };
  std::vector<Outgoing> outgoing_;
  std::vector<uint32_t> labels_;  // position of each; ~0: not yet
  std::vector<std::pair<uint32_t, Label>> jumps_;
};

}  // namespace rung::ir::interpreter
