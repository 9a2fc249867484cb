// SPDX-License-Identifier: Apache-2.0
// A chart of the XML: its elements and wires, and how they become textual SFC. Private to chart.cpp (the graph),
// sfc.cpp (steps and actions), macros.cpp (macro steps), conditions.cpp (transitions).
//
// Wires point upwards: each element names its predecessors. The steps of a transition are found by following wires
// through divergences and convergences; the branches of a divergence are the elements that name it, in file order,
// which is the order in which they are evaluated. A chart with an error in its graph is not written at all, so one
// mistake gives one error. TC6 2.01; TM/TP manual 5.5; IEC 61131-3 ed. 3, 6.7.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "frontend/import/chart_writer.h"
#include "frontend/import/plcopen/import.h"

namespace rung::importer::plcopen {

enum class NodeKind : uint8_t {
  Step,
  Wait,  // added step in which a branch waits that ends with a transition
  MacroStep,
  Transition,
  Jump,
  SelectionDivergence,
  SelectionConvergence,
  SimultaneousDivergence,
  SimultaneousConvergence,
  ActionBlock,
  Connector,
  Continuation,
  Input,  // inVariable
  Contact,
  Rail,   // leftPowerRail
  Other,  // comments, and elements of networks only
};

struct ChartWire {
  uint32_t from;  // node
  Loc loc;
};
struct ChartNode {
  const xml::Element* element;
  NodeKind kind;
  uint32_t first_wire, end_wire;  // its inputs, in Chart::wires_
};

class Chart {
 public:
  Chart(Import& import, const xml::Element& chart, const xml::Element& pou, const std::string& name)
      : import_(import), document_(import.document), writer_(import.out), chart_(chart), pou_(pou), name_(name) {}

  void write();

 private:
  // The chart of a macro step.
  Chart(Chart& outer, const xml::Element& chart, uint32_t node)
      : import_(outer.import_),
        document_(outer.document_),
        writer_(outer.writer_),
        chart_(chart),
        pou_(outer.pou_),
        name_(outer.name_),
        outer_(&outer),
        own_prefix_(outer.own_prefix_ + std::to_string(node) + "_") {}

  using Steps = std::vector<uint32_t>;  // nodes
  // The steps that must be active before an element can be reached: all steps of one of the sets.
  struct Paths {
    enum class State : uint8_t { Unknown, Busy, Known } state = State::Unknown;
    bool never = false;  // after a branch that ends with a jump
    std::vector<Steps> sets;
  };
  // A condition that is named or more than an expression: a TRANSITION without FROM.
  struct Definition {
    std::string name;
    const xml::Element* element;  // <transition> with bodies, <inline>, or the <condition> with wires
  };
  struct Macro {
    uint32_t node;
    std::unique_ptr<Chart> chart;
    // Nodes of its chart; UINT32_MAX: the macro has no predecessor or no successor.
    uint32_t entry = UINT32_MAX, exit = UINT32_MAX;
  };
  // The condition of a transition: one of these.
  struct Condition {
    const xml::Element* text = nullptr;  // an <ST>; the condition is [begin, end) of its decoded content
    size_t begin = 0, end = 0;
    const xml::Attribute* variable = nullptr;
    std::vector<uint32_t> wires;  // from nodes that are expressions
    std::string definition;
    bool negated = false;
  };

  Report report(Diag diag, Loc loc, std::initializer_list<std::string_view> args) {
    ok_ = false;
    return import_.diagnostics.report(diag, loc, args);
  }
  std::string_view raw(const xml::Element& element, std::string_view attribute) const {
    const xml::Attribute* found = document_.attribute(element, attribute);
    return found == nullptr ? std::string_view{} : found->raw;
  }

  // ---- the graph (chart.cpp)
  std::string nameOf(uint32_t node) const;  // for messages
  void readNodes();
  std::vector<ChartWire> wiresOf(const xml::Element& holder);
  void joinConnectors();
  void addWaitingSteps();
  void findLabels();
  void checkOrder();
  void connectActionBlocks();
  void connectTransition(uint32_t node);
  const Paths& before(uint32_t node, uint32_t depth);
  const Paths* pathsThrough(const ChartWire& wire, uint32_t node, uint32_t depth);
  void addPaths(Paths& paths, uint32_t node, uint32_t depth);
  void addUnited(Paths& paths, uint32_t node, uint32_t depth);
  void after(uint32_t node, uint32_t transition, uint32_t depth);
  bool spend(uint32_t node, size_t steps);
  void connect();
  void writeElements();

  // ---- macro steps (macros.cpp)
  void connectMacro(uint32_t node);
  void findEnd(Macro& macro, bool entry);
  void writeMacro(const Macro& macro);

  // ---- steps (sfc.cpp)
  void writeStep(uint32_t node);
  xml::Excerpt stepName(uint32_t node) const;
  xml::Excerpt stepTime(const xml::Element& step, std::string_view guid, std::string_view attribute) const;
  void writeStepFlags();
  void readActions(uint32_t node, ChartStep& step);
  void readAction(const xml::Element& action, ChartStep& step);
  void readTime(const xml::Element& action, StepAction& out);
  std::string newActionNumber();
  xml::Excerpt actionName(const xml::Element& action, const xml::Attribute* name);
  const xml::Element* ownAttribute(const xml::Element& element, std::string_view guid) const;

  // ---- transitions (conditions.cpp)
  void writeTransition(uint32_t node);
  std::vector<xml::Excerpt> namesOf(const std::vector<uint32_t>& steps) const;
  bool readCondition(uint32_t node, Condition& out);
  bool readBody(const xml::Element& inline_body, const std::string& name, Condition& out);
  void define(const std::string& name, const xml::Element& element);
  void writeExpression(const Condition& condition);
  bool isExpression(uint32_t node, uint32_t depth, uint32_t& budget) const;
  void writeDisjunction(const std::vector<uint32_t>& from);
  void writeOperand(uint32_t node);
  std::vector<uint32_t> sourcesOf(uint32_t node) const;
  const xml::Element* namedTransition(std::string_view name);
  void writeDefinition(const Definition& definition);

  Import& import_;
  const xml::Document& document_;
  ChartWriter writer_;
  const xml::Element& chart_;
  const xml::Element& pou_;
  const std::string& name_;
  Chart* outer_ = nullptr;  // the chart that contains the macro step
  std::string own_prefix_;  // of the names of unnamed steps and conditions: macro steps share the names of the chart
  bool ok_ = true;
  size_t spent_ = 0;  // steps in all Ways
  std::vector<ChartNode> nodes_;
  std::vector<ChartWire> wires_;
  std::unordered_map<std::string_view, uint32_t> by_id_;
  std::unordered_map<std::string, uint32_t> labels_;  // of parallel branches, in upper case
  std::vector<std::vector<uint32_t>> after_;          // by node: its successors, in file order
  std::vector<Paths> ways_;                           // by node
  std::vector<std::vector<uint32_t>> targets_;        // by node, of transitions
  std::vector<uint32_t> passed_;  // by node: the last transition whose wires were followed through it
  std::vector<std::vector<uint32_t>> action_blocks_;            // by node, of steps
  std::unordered_map<std::string, const xml::Element*> named_;  // transitions of the POU, in upper case
  std::vector<Definition> definitions_;
  std::vector<Macro> macros_;
  std::unordered_set<const xml::Element*> defined_;
  std::unordered_map<std::string, std::string> own_actions_;  // by variable
};

}  // namespace rung::importer::plcopen
