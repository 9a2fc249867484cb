// SPDX-License-Identifier: Apache-2.0
// The graph of a chart: elements, wires, and the steps before and after each transition; see chart.h. Memory and time
// are linear in the size of the chart, except for transitions from many steps.
#include "frontend/import/plcopen/chart.h"

#include <algorithm>
#include <utility>

#include "frontend/import/diagnostics.h"
#include "frontend/source/names.h"

namespace rung::importer::plcopen {
namespace {

constexpr std::pair<std::string_view, NodeKind> kKinds[] = {
    {"step", NodeKind::Step},
    {"macroStep", NodeKind::MacroStep},
    {"transition", NodeKind::Transition},
    {"jumpStep", NodeKind::Jump},
    {"selectionDivergence", NodeKind::SelectionDivergence},
    {"selectionConvergence", NodeKind::SelectionConvergence},
    {"simultaneousDivergence", NodeKind::SimultaneousDivergence},
    {"simultaneousConvergence", NodeKind::SimultaneousConvergence},
    {"actionBlock", NodeKind::ActionBlock},
    {"connector", NodeKind::Connector},
    {"continuation", NodeKind::Continuation},
    {"inVariable", NodeKind::Input},
    {"contact", NodeKind::Contact},
    {"leftPowerRail", NodeKind::Rail}};

constexpr size_t kMaxSteps = 1'000'000;  // in the paths to all elements of a chart
constexpr uint32_t kMaxWires = 1000;     // in a row

}  // namespace

std::string Chart::nameOf(uint32_t node) const {
  const ChartNode& n = nodes_[node];
  std::string name = document_.value(*n.element, n.kind == NodeKind::Jump ? "targetName" : "name");
  if (name.empty()) name = "localId " + std::string(raw(*n.element, "localId"));
  return std::string(n.element->name) + " `" + name + "`";
}

// Forbids a duplicate localId in a chart. TC6 2.01.
//   fails   <step localId="1" …/> <step localId="1" …/>          E1060
void Chart::readNodes() {
  for (const xml::Element& e : document_.children(chart_)) {
    NodeKind kind = NodeKind::Other;
    for (const auto& [name, of] : kKinds)
      if (e.name == name) kind = of;
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({&e, kind, 0, 0});
    const bool is_step = kind == NodeKind::Step || kind == NodeKind::MacroStep || kind == NodeKind::Jump;
    if (is_step && !checkName(import_, e, kind == NodeKind::Jump ? "targetName" : "name")) ok_ = false;
    const xml::Attribute* id = document_.attribute(e, "localId");
    if (id == nullptr) continue;
    const auto [known, fresh] = by_id_.emplace(id->raw, index);
    if (!fresh)
      report(diag::DuplicateLocalId, id->loc, {id->raw})
          .length(static_cast<uint32_t>(id->raw.size()))
          .alsoDeclaredHere(nodes_[known->second].element->loc);
  }
  after_.resize(nodes_.size());
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].first_wire = static_cast<uint32_t>(wires_.size());
    for (const ChartWire& wire : wiresOf(*nodes_[i].element)) {
      wires_.push_back(wire);
      std::vector<uint32_t>& next = after_[wire.from];
      if (next.empty() || next.back() != i) next.push_back(i);
    }
    nodes_[i].end_wire = static_cast<uint32_t>(wires_.size());
  }
  joinConnectors();
  addWaitingSteps();
  findLabels();
  ways_.resize(nodes_.size());
  targets_.resize(nodes_.size());
  passed_.resize(nodes_.size(), UINT32_MAX);
  action_blocks_.resize(nodes_.size());
}

// A branch may end with a transition directly above the double line: it then waits there for the others, in an added
// step. Syntax manual 5.9.8.
void Chart::addWaitingSteps() {
  const auto count = static_cast<uint32_t>(nodes_.size());
  for (uint32_t i = 0; i < count; ++i) {
    if (nodes_[i].kind != NodeKind::SimultaneousConvergence) continue;
    for (uint32_t w = nodes_[i].first_wire; w < nodes_[i].end_wire; ++w) {
      const uint32_t from = wires_[w].from;
      if (nodes_[from].kind != NodeKind::Transition && nodes_[from].kind != NodeKind::SelectionConvergence) continue;
      const auto wait = static_cast<uint32_t>(nodes_.size());
      const auto next = std::find(after_[from].begin(), after_[from].end(), i);
      if (next == after_[from].end()) continue;  // duplicate wire
      *next = wait;
      nodes_.push_back({nodes_[from].element, NodeKind::Wait, 0, 0});
      after_.push_back({i});
      for (uint32_t same = w; same < nodes_[i].end_wire; ++same)
        if (wires_[same].from == from) wires_[same].from = wait;
    }
  }
}

// Jumps may name a parallel branch as target.
void Chart::findLabels() {
  constexpr std::string_view kName = "38391c6d";
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind != NodeKind::SimultaneousDivergence) continue;
    const xml::Element* own = ownAttribute(*nodes_[i].element, kName);
    const std::string name = own != nullptr ? textOf(import_, *own) : document_.value(*nodes_[i].element, "name");
    if (!name.empty()) labels_.emplace(upper(name), i);
  }
}

// Forbids a step directly after a step. IEC 61131-3 ed. 3, 6.7.5; syntax manual 5.9.6.
//   fails   <step localId="2"> with a wire from <step localId="1">          E1057
void Chart::checkOrder() {
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    const NodeKind kind = nodes_[i].kind;
    if (kind != NodeKind::Step && kind != NodeKind::MacroStep && kind != NodeKind::Jump &&
        kind != NodeKind::SimultaneousDivergence)
      continue;
    for (uint32_t w = nodes_[i].first_wire; w < nodes_[i].end_wire; ++w) {
      const NodeKind from = nodes_[wires_[w].from].kind;
      if (from == NodeKind::Step || from == NodeKind::MacroStep || from == NodeKind::SimultaneousConvergence ||
          from == NodeKind::SelectionDivergence)
        report(diag::ChartNoTransitionBetween, wires_[w].loc, {nameOf(wires_[w].from), nameOf(i)});
    }
  }
}

// The wires into an element, or into the condition of a transition. Forbids wires from undefined elements. TC6 2.01.
//   fails   <connection refLocalId="99"/>          E1061
std::vector<ChartWire> Chart::wiresOf(const xml::Element& holder) {
  std::vector<ChartWire> out;
  const auto add = [&](const xml::Element& connection) {
    const xml::Attribute* id = document_.attribute(connection, "refLocalId");
    if (id == nullptr) {
      ok_ = checkName(import_, connection, "refLocalId") && ok_;
      return;
    }
    const auto found = by_id_.find(id->raw);
    if (found != by_id_.end()) {
      out.push_back({found->second, id->loc});
      return;
    }
    report(diag::ChartWireNowhere, id->loc, {id->raw}).length(static_cast<uint32_t>(id->raw.size()));
  };
  for (const xml::Element& e : document_.children(holder)) {
    if (e.name == "connection") add(e);  // TC6 1.01: in a condition
    if (e.name != "connectionPointIn") continue;
    for (const xml::Element& c : document_.children(e))
      if (c.name == "connection") add(c);
  }
  return out;
}

// A continuation reads the wire of the connector with its name.
void Chart::joinConnectors() {
  std::unordered_map<std::string_view, uint32_t> connectors;
  for (uint32_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].kind == NodeKind::Connector) connectors.emplace(raw(*nodes_[i].element, "name"), i);
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind != NodeKind::Continuation) continue;
    const auto from = connectors.find(raw(*nodes_[i].element, "name"));
    if (from == connectors.end()) continue;
    nodes_[i].first_wire = nodes_[from->second].first_wire;
    nodes_[i].end_wire = nodes_[from->second].end_wire;
    after_[from->second].push_back(i);
  }
}

void Chart::connectActionBlocks() {
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind != NodeKind::ActionBlock) continue;
    bool found = false;
    for (uint32_t w = nodes_[i].first_wire; w < nodes_[i].end_wire; ++w) {
      if (nodes_[wires_[w].from].kind != NodeKind::Step) continue;
      action_blocks_[wires_[w].from].push_back(i);
      found = true;
    }
    if (!found && ok_) report(diag::ChartNoStepBefore, nodes_[i].element->loc, {nameOf(i)});
  }
}

// Wires may split and join any number of times, so the number of paths is limited.
bool Chart::spend(uint32_t node, size_t steps) {
  spent_ += steps + 1;
  if (spent_ <= kMaxSteps) return true;
  if (ok_) report(diag::XmlTooLarge, nodes_[node].element->loc, {std::to_string(kMaxSteps), "paths through one chart"});
  ok_ = false;
  return false;
}

// The paths to the source of the wire. Null: it comes from a transition, which was reported.
const Chart::Paths* Chart::pathsThrough(const ChartWire& wire, uint32_t node, uint32_t depth) {
  if (nodes_[wire.from].kind != NodeKind::Transition) return &before(wire.from, depth + 1);
  report(diag::ChartNoStepBetween, wire.loc, {nameOf(wire.from), nameOf(node)});
  return nullptr;
}

// Forbids a transition directly after a jump. IEC 61131-3 ed. 3, 6.7.5.
// Adds one set of steps for each path to the node. A branch that ends with a jump adds none, although editors draw it
// to the convergence.
void Chart::addPaths(Paths& paths, uint32_t node, uint32_t depth) {
  uint32_t jump = UINT32_MAX;
  bool all_leave = nodes_[node].first_wire < nodes_[node].end_wire;
  for (uint32_t w = nodes_[node].first_wire; w < nodes_[node].end_wire; ++w) {
    const uint32_t from = wires_[w].from;
    if (nodes_[from].kind == NodeKind::Jump) {
      jump = from;
      if (nodes_[node].kind != NodeKind::SelectionConvergence)
        report(diag::ChartNoStepBetween, wires_[w].loc, {nameOf(from), nameOf(node)});
      continue;
    }
    const Paths* inner = pathsThrough(wires_[w], node, depth);
    all_leave = all_leave && inner != nullptr && inner->never;
    if (inner == nullptr || inner->never) continue;
    for (const Steps& steps : inner->sets) {
      if (!spend(node, steps.size())) return;
      paths.sets.push_back(steps);
    }
  }
  paths.never = all_leave;
  if (all_leave && jump != UINT32_MAX && ok_)
    import_.diagnostics.report(diag::ChartNeverConverges, nodes_[jump].element->loc, {nameOf(jump), nameOf(node)});
}

// One set from each input, in all combinations; usually there is one. A branch that ends with a jump never reaches the
// convergence that editors draw after it.
void Chart::addUnited(Paths& paths, uint32_t node, uint32_t depth) {
  paths.sets.push_back({});
  for (uint32_t w = nodes_[node].first_wire; w < nodes_[node].end_wire; ++w) {
    const uint32_t from = wires_[w].from;
    if (nodes_[from].kind == NodeKind::Jump) {
      if (!paths.never)
        import_.diagnostics.report(diag::ChartNeverConverges, nodes_[from].element->loc, {nameOf(from), nameOf(node)});
      paths.never = true;
      continue;
    }
    const Paths* inner = pathsThrough(wires_[w], node, depth);
    if (inner == nullptr) continue;
    paths.never = paths.never || inner->never;
    std::vector<Steps> united;
    for (const Steps& a : paths.sets) {
      for (const Steps& b : inner->sets) {
        if (!spend(node, a.size() + b.size())) return;
        united.push_back(a);
        united.back().insert(united.back().end(), b.begin(), b.end());
      }
    }
    paths.sets = std::move(united);
  }
}

const Chart::Paths& Chart::before(uint32_t node, uint32_t depth) {
  Paths& paths = ways_[node];
  if (paths.state == Paths::State::Known) return paths;
  if (paths.state == Paths::State::Busy || depth == kMaxWires) {
    paths.state = Paths::State::Known;
    report(diag::ChartCycle, nodes_[node].element->loc, {nameOf(node)});
    return paths;
  }
  paths.state = Paths::State::Busy;
  switch (nodes_[node].kind) {
    case NodeKind::Step:
    case NodeKind::Wait:
    case NodeKind::MacroStep: paths.sets.push_back({node}); break;
    case NodeKind::SelectionDivergence:
    case NodeKind::SelectionConvergence:
    case NodeKind::Connector:
    case NodeKind::Continuation: addPaths(paths, node, depth); break;
    case NodeKind::SimultaneousConvergence: addUnited(paths, node, depth); break;
    case NodeKind::SimultaneousDivergence:
    case NodeKind::Transition:
    case NodeKind::Jump:
    case NodeKind::ActionBlock:
    case NodeKind::Input:
    case NodeKind::Contact:
    case NodeKind::Rail:
    case NodeKind::Other:
      report(diag::ChartNoStepBetween, nodes_[node].element->loc, {nameOf(node), "a transition"});
      break;
  }
  paths.state = Paths::State::Known;
  return paths;
}

// The steps and jumps that the transition activates when it fires, found by following the wires out of `node`.
void Chart::after(uint32_t node, uint32_t transition, uint32_t depth) {
  if (depth == kMaxWires || passed_[node] == transition) {
    report(diag::ChartCycle, nodes_[node].element->loc, {nameOf(node)});
    return;
  }
  passed_[node] = transition;
  std::vector<uint32_t>& out = targets_[transition];
  bool any = false;
  for (const uint32_t next : after_[node]) {
    if (nodes_[next].kind == NodeKind::Other || nodes_[next].kind == NodeKind::ActionBlock) continue;
    if (any && nodes_[node].kind != NodeKind::SimultaneousDivergence) {
      report(diag::ChartSplits, nodes_[next].element->loc, {nameOf(node), nameOf(next)});
      return;
    }
    any = true;
    switch (nodes_[next].kind) {
      case NodeKind::Step:
      case NodeKind::Wait:
      case NodeKind::MacroStep: out.push_back(next); break;
      case NodeKind::Jump: {
        const auto label = labels_.find(upper(document_.value(*nodes_[next].element, "targetName")));
        if (label != labels_.end() && !import_.isStepName(label->first))
          after(label->second, transition, depth + 1);
        else
          out.push_back(next);
        break;
      }
      case NodeKind::SelectionConvergence:
      case NodeKind::SimultaneousDivergence:
      case NodeKind::Connector:
      case NodeKind::Continuation: after(next, transition, depth + 1); break;
      case NodeKind::Transition:
      case NodeKind::SelectionDivergence:
      case NodeKind::SimultaneousConvergence:
      case NodeKind::ActionBlock:
      case NodeKind::Input:
      case NodeKind::Contact:
      case NodeKind::Rail:
      case NodeKind::Other:
        report(diag::ChartNoStepBetween, nodes_[next].element->loc, {nameOf(node), nameOf(next)});
        break;
    }
    if (!ok_) return;
  }
  if (!any) report(diag::ChartLeadsNowhere, nodes_[node].element->loc, {nameOf(node)});
}

// Forbids a transition without a step before or after it. IEC 61131-3 ed. 3, 6.7.3.
//   fails   <transition localId="3"> without connectionPointIn          E1062
void Chart::connectTransition(uint32_t node) {
  Paths& paths = ways_[node];
  const uint32_t errors = import_.diagnostics.errorCount();
  addPaths(paths, node, 0);
  if (paths.never) paths.sets.clear();
  if (import_.diagnostics.errorCount() != errors || paths.never) return;
  if (paths.sets.empty())
    report(diag::ChartNoStepBefore, nodes_[node].element->loc, {nameOf(node)});
  else
    after(node, node, 0);
}

void Chart::connect() {
  readNodes();
  connectActionBlocks();
  checkOrder();
  for (uint32_t i = 0; i < nodes_.size() && ok_; ++i)
    if (nodes_[i].kind == NodeKind::Transition) connectTransition(i);
  for (uint32_t i = 0; i < nodes_.size() && ok_; ++i)
    if (nodes_[i].kind == NodeKind::MacroStep) connectMacro(i);
}

}  // namespace rung::importer::plcopen
