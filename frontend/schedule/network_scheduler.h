// SPDX-License-Identifier: Apache-2.0
// The implementation of scheduleNetworks(). Private to frontend/schedule: network_schedule.cpp (wires, contacts, coils,
// jumps), network_boxes.cpp.
//
// How it works. Elements with an effect are visited in the order of the graph; the sources of their wires are resolved
// first (network_walk.h). Resolving an element emits its statements, or decides that its reader makes it part of an
// expression. An expression is built only when everything that it reads is resolved, so no statement is emitted in the
// middle of one.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/schedule/edge_coils.h"
#include "frontend/schedule/network_graph.h"
#include "frontend/schedule/network_walk.h"
#include "frontend/syntax/clone.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/tree_builder.h"

namespace rung::diagram {

// Of one expression; a larger one is cut by a temporary.
constexpr uint16_t kMaxHeight = 100;

class Scheduler {
 public:
  Scheduler(Tree& tree, Names& names, Diagnostics& diagnostics, Signatures& signatures,
            const NetworkVariables& variables, EdgeCoils edge_coils)
      : tree_(tree),
        names_(names),
        diagnostics_(diagnostics),
        signatures_(signatures),
        variables_(variables),
        edge_coils_(edge_coils) {}

  ScheduledBody run(const PouDecl& pou);

 private:
  // The walk through the body tells the scheduler this.
  struct Visitor {
    Scheduler& scheduler;
    void resolve(uint32_t element) {
      scheduler.resolve(element);
      scheduler.detectEdges(element);
    }
    void readOrdered(uint32_t) {}
    void readLastCycle(uint32_t source, uint32_t reader) { scheduler.readLastCycle(source, reader); }
    void breakCycle(uint32_t element) { scheduler.breakCycle(element); }
  };

  void checkCoils();
  void checkHolding(const PouDecl& pou);
  void checkBooleans();
  void checkModifiers();
  bool isStored(uint32_t element, const DiagramPin& pin) const;
  PinStorage storageOf(const DiagramElement& e) const;

  // ---- the walk
  void readLastCycle(uint32_t source, uint32_t reader);
  void breakCycle(uint32_t first);
  void resolve(uint32_t element);
  void detectEdges(uint32_t element);

  // ---- elements
  void resolveContact(uint32_t element);
  void resolveConnector(uint32_t element);
  void resolveAssignment(uint32_t element);
  void resolveComposer(uint32_t element);
  void resolveExecute(uint32_t element);
  void resolveJump(uint32_t element);
  void assignTo(uint32_t element, ExprId value, PinStorage storage, NameId guard);
  ExprId operandOf(uint32_t element);
  bool readable(uint32_t element);

  // ---- boxes (network_boxes.cpp)
  struct Call;
  void resolveBox(uint32_t element);
  bool isOperator(const DiagramElement& e) const;
  bool checkBlock(const DiagramElement& e);
  void resolveOperator(uint32_t element, Call& call);
  void resolveCall(uint32_t element, Call& call);
  void giveResult(uint32_t element, uint32_t result, ExprId value);
  uint32_t soleTarget(uint32_t source) const;
  bool checkOperands(uint32_t element, const Call& call);
  void callWithEno(uint32_t element, Call& call, uint32_t eno, uint32_t result);
  void addControl(uint32_t element, Call& call, uint32_t eno);
  NameId keptEnable(uint32_t element, ExprId condition);
  bool hasTargets(uint32_t element) const;
  void guard(uint32_t element, NameId condition);
  ExprId targetOf(uint32_t element, uint32_t result);
  bool fillArguments(uint32_t element, Call& call);
  uint32_t resultOf(uint32_t element, const Signature& signature) const;
  ExprId readBox(uint32_t source);

  // ---- wires
  // The value of a pin; none: not connected.
  ExprId valueOf(const DiagramElement& e, const DiagramPin& pin);
  // The value of a source with the modifiers of its pin, and without.
  ExprId read(uint32_t source);
  ExprId plainValue(uint32_t source);
  uint16_t heightOf(const DiagramElement& e) const;
  ExprId joined(const DiagramPin& pin, uint32_t first, uint32_t count);
  const DiagramPin* pinNamed(const DiagramElement& e, std::string_view name, PinDirection direction) const;

  // ---- nodes
  ExprId inverted(ExprId operand, Loc loc) { return build_.unary(UnaryOp::Not, operand, loc); }
  // The edge of `value`, detected by the instance `sensor`, which is called here.
  ExprId sensed(NameId sensor, ExprId value, Loc loc);
  ExprId outputOf(NameId sensor, Loc loc);
  void emit(StmtId statement);
  // Pending values that read what the statement writes are evaluated before it.
  void keepReadersOf(StmtId statement);
  void keepReadersOf(ExprId written);
  void keepAllPending();
  void notePending(uint32_t source);
  void assign(ExprId target, ExprId value, Loc loc, AssignOp op = AssignOp::Assign) {
    emit(build_.assign(op, target, value, loc));
  }
  void conditional(ExprId condition, Loc loc, StmtId statement) {
    emit(build_.ifStatement(condition, {&statement, 1}, loc, kConditionalOp));
  }
  NameId newTemporary(const std::string& base, Loc loc);
  // Evaluates a source now, into a temporary or its variable.
  void keep(uint32_t source, const std::string& base);
  void keep(uint32_t source, ExprId value, const std::string& base);
  std::string wireName(uint32_t element) const;

  Tree& tree_;
  TreeBuilder build_{tree_};
  Names& names_;
  Diagnostics& diagnostics_;
  Signatures& signatures_;
  const NetworkVariables& variables_;
  EdgeCoils edge_coils_;
  NetworkLanguage language_ = NetworkLanguage::Ladder;
  const char* function_ = nullptr;  // the kind of POU if it keeps no state
  Graph graph_;
  std::optional<ExecutionWalk> walk_;
  std::vector<bool> operand_taken_;
  std::vector<bool> target_of_;     // sources that a variable reads
  std::vector<bool> failed_;        // elements with a reported error: their readers report none
  std::vector<bool> assigned_;      // variables that a box with EN assigns itself
  std::vector<uint32_t> order_of_;  // of an element with an effect: its index among the roots
  std::unordered_map<uint32_t, std::vector<uint32_t>> readers_;  // by the key of a name: sources whose pending value
                                                                 // reads it
  std::vector<uint32_t> calls_open_;                             // sources whose pending value contains a call
  std::vector<std::pair<uint32_t, uint32_t>> written_;           // network, key of a name that it writes; sorted
  std::vector<bool> network_calls_;                              // by the network's first element
  std::vector<StmtId> out_;
  std::vector<DeclId> temporaries_;
};

}  // namespace rung::diagram
