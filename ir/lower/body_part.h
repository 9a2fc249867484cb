// SPDX-License-Identifier: Apache-2.0
// All parts of lowering do this with a body: make nodes with the checks that the options ask for, temporaries, and the
// order of evaluation. BodyPart is the base of the parts (lowering.h); it changes nothing but the body's IR. The nodes
// are made in building.cpp; what moves to a temporary is decided in evaluation_order.cpp.
#pragma once

#include <unordered_map>
#include <vector>

#include "ir/builder.h"
#include "ir/walk.h"
#include "sema/project.h"

namespace rung::ir {

using types::TypeInfo;
using types::TypeKind;
using types::TypeTable;
using types::Value;

struct ModuleLowering;
struct BodyLowering;
class PlaceLowering;
class ValueLowering;
class CallLowering;
class ObjectLowering;

// A list or program, in which variables of the module are.
struct Root {
  bool is_list;  // else a program
  uint32_t index;
  TypeId record;
};

// The body in work and what the parts know of it.
struct BodyState {
  BodyState(ModuleLowering& in, Body& body, sema::PouId pou, BodyLowering& parts);

  ModuleLowering& in;
  Body& body;
  sema::PouId pou;
  BodyLowering& parts;
  Builder build;
  std::vector<uint32_t> local_of;                          // by Var::field of a local: local index + 1
  std::vector<std::pair<uint32_t, uint32_t>> edge_locals;  // R_EDGE, F_EDGE pins: VarId and the local with the edge
  struct SavedField {  // temporaries.cpp: a field of the instance and the temporary with its value before the call
    sema::VarId field;
    uint32_t local;
  };
  std::vector<SavedField> saved_fields;
  uint32_t result_local = kNoBit;
  std::unordered_map<uint32_t, uint32_t> label_numbers;  // by the key of the name
  // Inside the right operand of a codesys AND or OR that calls functions: a temporary that is TRUE when the operand's
  // value matters. Its checks count only then.
  ExprId guard;
  uint32_t element = 0;  // the current element of an array whose elements have arguments of their own for FB_Init
  sema::CallId given;    // the arguments of FB_Init for an object that __NEW creates
  ExprId logical;        // the temporary of the last AND or OR that needed one
  uint32_t effects = 0, effects_counted = 1;  // of the statements up to that one
};

// A position in the open block. `effects` shows whether statements since then could change a variable.
struct InsertionPoint {
  StmtId last;
  uint32_t effects;
};

class BodyPart {
 public:
  explicit BodyPart(BodyState& state);

  // ---- nodes
  template <class T>
  ExprId add(Loc loc, TypeId type, const T& fields, uint8_t checks = 0) {
    return build_.add(loc, type, fields, checks);
  }
  template <class T>
  StmtId append(Loc loc, const T& fields) {
    return build_.append(loc, fields);
  }
  Slice<ExprId> list(std::span<const ExprId> operands) { return build_.list(operands); }
  ExprId constant(TypeId type, uint64_t bits, Loc loc);
  ExprId constantBool(bool value, Loc loc) { return constant(types::kBool, value ? 1 : 0, loc); }
  ExprId stringConstant(TypeId type, NameId string, Loc loc);
  ExprId ofValue(const Value& value, Loc loc);
  ExprId zero(TypeId type, Loc loc);  // a scalar's 0, else all bytes zero
  ExprId local(uint32_t index, Loc loc);
  ExprId temp(TypeId type, Loc loc);  // a new temporary, as a place
  ExprId field(ExprId base, uint32_t index, TypeId type, Loc loc);
  ExprId element(ExprId array, std::span<const ExprId> indices, Loc loc);  // without check
  ExprId self(Loc loc);
  ExprId place(const Root& root, Loc loc);
  // The place of an object as what it extends.
  ExprId asBase(ExprId place, sema::PouId base, Loc loc);
  ExprId unary(Op op, TypeId type, ExprId operand, Loc loc);
  // An operation that the program has written: with --checks=overflow its result must fit. Not in libraries.
  ExprId arithmetic(ExprId operation);
  bool checksOverflow() const;
  bool wraps() const;
  const LanguageProfile& profile() const { return isLibraryCode() ? profileOf(Dialect::Library) : project_.profile; }
  bool isLibraryCode() const { return pou_ && project_.pou(pou_).library; }
  ExprId binary(Op op, TypeId type, ExprId left, ExprId right, Loc loc);
  ExprId convert(ExprId operand, TypeId to, Loc loc, types::Rounding rounding = types::Rounding::ToEven);
  // Nothing where it has that type.
  ExprId convertValue(ExprId value, TypeId to, Loc loc, types::Rounding rounding = types::Rounding::ToEven);
  ExprId copy(ExprId expr) { return build_.copy(expr); }  // for a second use
  void assign(ExprId place, ExprId value, Loc loc);
  void callOn(BodyId callee, ExprId self, Loc loc);

  TypeId typeOf(ExprId expr) const { return body_.expr(expr).type; }
  TypeId strip(TypeId type) const { return types_.resolve(type); }
  bool isAggregate(TypeId type) const { return ir::isAggregate(types_, type); }  // in memory, passed by reference
  bool mayFault(ExprId expr) const { return ir::mayFault(body_, expr); }
  // False for a bit, and for a variable that may be less aligned than its type: in-outs and outputs take a copy.
  bool isReferable(ExprId place) const;
  uint32_t alignmentOf(ExprId place) const;
  uint32_t alignmentInImage(ExprId view) const;
  bool isTemp(ExprId place) const;   // a compiler temporary or a part of one
  bool isStable(ExprId expr) const;  // a constant or a temporary: reading it later gives the same

  // Lowers into a separate block; returns its first statement.
  template <class Fill>
  StmtId block(Fill fill) {
    const Block outer = build_.open();
    fill();
    return build_.close(outer);
  }

  // ---- the order of evaluation
  ExprId toTemp(ExprId value, Loc loc);
  // The same place without operands that a later statement could change: indices and pointers go to temporaries.
  ExprId stable(ExprId place);
  InsertionPoint here() { return {build_.block().last, effects()}; }
  // Lowers `next`. When the statements that it emitted could change what `before` reads, or must not run when `before`
  // faults, `before` moves to a temporary in front of them.
  template <class Lower>
  ExprId lowerAfter(std::initializer_list<ExprId*> before, Lower next) {
    const InsertionPoint point = here();
    const ExprId value = next();
    spill(point, before);
    return value;
  }
  void spill(InsertionPoint point, std::initializer_list<ExprId*> values);
  void spillPlace(InsertionPoint point, ExprId& place);  // stays a place: its indices and pointers move

 protected:
  PlaceLowering& places() const;
  ValueLowering& values() const;
  CallLowering& calls() const;
  ObjectLowering& objects() const;

  BodyState& state_;
  ModuleLowering& in_;
  const sema::Project& project_;
  const Tree& tree_;
  TypeTable& types_;
  Body& body_;
  const sema::PouId& pou_;
  Builder& build_;

 private:
  void makeStable(ExprId& operand, Loc loc);
  bool mustSpill(InsertionPoint point, ExprId value);
  bool hasEffect(const Stmt& stmt) const;  // of its own, without its blocks
  uint32_t effects();                      // statements so far that change more than temporaries
  // Emits at `point` instead of at the end of the block.
  template <class Fill>
  void insertAt(InsertionPoint point, Fill fill) {
    Block& open = build_.block();
    const Block rest = point.last ? Block{body_.stmt(point.last).next, open.last} : open;
    open = {point.last ? open.first : StmtId{}, point.last};
    if (point.last) body_.stmt(point.last).next = {};
    fill();
    if (open.last)
      body_.stmt(open.last).next = rest.first;
    else
      open.first = rest.first;
    if (rest.first) open.last = rest.last;
  }
};

}  // namespace rung::ir
