// SPDX-License-Identifier: Apache-2.0
// Charts as TC6 elements; see exporter.h. The textual chart names the steps of each transition; here these become
// elements and wires. Steps come in source order, then the transitions, so that the import finds both orders again; a
// wire leads down, and a link up or across becomes a jump.
#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include "frontend/export/exporter.h"
#include "frontend/syntax/inline_actions.h"
#include "frontend/syntax/sfc.h"

namespace rung::exporter {
namespace {

// The GUIDs that 3S uses for the step actions without a qualifier.
constexpr std::string_view kEntry = "a6b08bd8-b696-47e3-9cbf-7408b61c9ff8",
                           kActive = "700a583f-b4d4-43e4-8c14-629c7cd3bec8",
                           kExit = "a2621e18-7de3-4ea6-ae6d-89e9e0b7befd";

constexpr int kStepRow = 80, kStepColumn = 200;

class ChartExport {
 public:
  ChartExport(Export& to, const PouDecl& pou, BodyExport body)
      : to_(to),
        pou_(pou),
        body_(body),
        inline_actions_(to.tree, to.names, pou),
        steps_(to.tree.list(pou.steps)),
        transitions_(to.tree.list(pou.transitions)) {}

  void run();

 private:
  // localIds of elements.
  using Ids = std::vector<uint64_t>;
  struct Target {
    uint32_t step;
    bool jumps;
  };

  // The index of a declared step; sema reports undeclared ones.
  uint32_t indexOf(const Ident& step) const {
    const auto found = index_.find(to_.names.key(step.name).index);
    return found == index_.end() ? 0 : found->second;
  }
  void plan();
  std::string_view text(const SfcExpr& e) const {
    return to_.source->cut(to_.source->at(e.begin), to_.source->at(e.end));
  }
  void open(std::string_view element, uint64_t id);
  void position(int column, int row);
  void position(const SfcPosition& given);
  void wire(uint64_t from) {
    to_.xml.open("connectionPointIn").open("connection").attribute("refLocalId", std::to_string(from)).close();
    to_.xml.close();
  }
  void outputs(size_t count) {
    for (size_t i = 0; i < count; ++i) to_.xml.open("connectionPointOut").attribute("formalParameter", "sfc").close();
  }
  void size(const SfcPosition& given) {
    if (given.width == 0 && given.height == 0) return;
    to_.xml.attribute("height", std::to_string(given.height)).attribute("width", std::to_string(given.width));
  }
  void step(uint32_t i);
  void actions(uint32_t i);
  void ownActions(const SfcStep& step);
  void transition(uint32_t i);
  void condition(const SfcTransition& t);
  void comments();

  Export& to_;
  const PouDecl& pou_;
  const BodyExport body_;
  InlineActions inline_actions_;
  std::span<const SfcStep> steps_;
  std::span<const SfcTransition> transitions_;
  std::unordered_map<uint32_t, uint32_t> index_;    // of a step, by the key of its name
  std::vector<uint32_t> uses_;                      // by step: the number of transitions from it
  std::vector<Ids> into_;                           // by step: its predecessors
  std::vector<std::vector<Target>> targets_;        // by transition
  std::vector<uint64_t> step_id_, source_id_;       // by step; its output: the step itself, or its divergence
  std::vector<uint64_t> transition_id_, split_id_;  // by transition; its simultaneous divergence
  uint64_t next_id_ = 0;
  int row_ = 0;
};

void ChartExport::plan() {
  for (uint32_t i = 0; i < steps_.size(); ++i) index_.emplace(to_.names.key(steps_[i].name.name).index, i);
  uses_.resize(steps_.size());
  into_.resize(steps_.size());
  step_id_.resize(steps_.size());
  source_id_.resize(steps_.size());
  targets_.resize(transitions_.size());
  transition_id_.resize(transitions_.size());
  split_id_.resize(transitions_.size());
  for (const SfcTransition& t : transitions_)
    for (const Ident& from : to_.tree.list(t.from)) ++uses_[indexOf(from)];
  for (uint32_t i = 0; i < steps_.size(); ++i) {
    step_id_[i] = ++next_id_;
    source_id_[i] = uses_[i] > 1 ? ++next_id_ : step_id_[i];
  }
  for (uint32_t i = 0; i < transitions_.size(); ++i) {
    const SfcTransition& t = transitions_[i];
    if (t.from.empty()) continue;
    transition_id_[i] = ++next_id_;
    if (t.to.count > 1) split_id_[i] = ++next_id_;
    uint32_t last = 0;
    for (const Ident& from : to_.tree.list(t.from)) last = std::max(last, indexOf(from));
    // The order of a divergence's branches is the order of its elements: first steps in theirs, then jumps.
    for (const Ident& name : to_.tree.list(t.to)) {
      const uint32_t step = indexOf(name);
      const bool behind_jump = !targets_[i].empty() && targets_[i].back().jumps;
      const bool jumps = step <= last || behind_jump;
      targets_[i].push_back({step, jumps});
      if (jumps) continue;
      last = t.to.count > 1 ? step : last;
      into_[step].push_back(split_id_[i] != 0 ? split_id_[i] : transition_id_[i]);
    }
  }
}

void ChartExport::open(std::string_view element, uint64_t id) {
  to_.xml.open(element).attribute("localId", std::to_string(id));
}

void ChartExport::position(int column, int row) {
  to_.xml.open("position")
      .attribute("x", std::to_string(column * kStepColumn))
      .attribute("y", std::to_string(row * kStepRow))
      .close();
}

// The position in the file where the chart was drawn; otherwise below the previous element.
void ChartExport::position(const SfcPosition& given) {
  if (!given.placed) return position(0, row_);
  to_.xml.open("position").attribute("x", std::to_string(given.x)).attribute("y", std::to_string(given.y)).close();
}

void ChartExport::ownActions(const SfcStep& step) {
  AddData data(to_);
  if (step.min.value || step.max.value) {
    data.openOwn();
    to_.xml.open("step");
    if (step.min.value) to_.xml.attribute("min", text(step.min));
    if (step.max.value) to_.xml.attribute("max", text(step.max));
    to_.xml.close();
    data.close();
  }
  bool any = false;
  SfcQualifier last = SfcQualifier::N;
  for (const SfcAssociation& a : to_.tree.list(step.actions)) {
    const bool own =
        a.qualifier == SfcQualifier::Entry || a.qualifier == SfcQualifier::Active || a.qualifier == SfcQualifier::Exit;
    if (!own) continue;
    if (any && a.qualifier == last) to_.reportInexpressible(a.action.loc, "two actions of this kind in one step");
    last = a.qualifier;
    if (!any) {
      data.open("sfc/element");
      to_.xml.open("attributes");
    }
    any = true;
    to_.xml.open("attribute")
        .attribute("guid", a.qualifier == SfcQualifier::Entry    ? kEntry
                           : a.qualifier == SfcQualifier::Active ? kActive
                                                                 : kExit);
    to_.xml.text(to_.string(a.action.name));
    to_.xml.close();
  }
  if (!any) return;
  to_.xml.close();
  data.close();
}

void ChartExport::actions(uint32_t i) {
  bool any = false;
  int row = 0;
  for (const SfcAssociation& a : to_.tree.list(steps_[i].actions)) {
    std::string_view word;
    switch (a.qualifier) {
      case SfcQualifier::N: word = "N"; break;
      case SfcQualifier::R: word = "R"; break;
      case SfcQualifier::S: word = "S"; break;
      case SfcQualifier::L: word = "L"; break;
      case SfcQualifier::D: word = "D"; break;
      case SfcQualifier::P: word = "P"; break;
      case SfcQualifier::P0: word = "P0"; break;
      case SfcQualifier::P1: word = "P1"; break;
      case SfcQualifier::SD: word = "SD"; break;
      case SfcQualifier::DS: word = "DS"; break;
      case SfcQualifier::SL: word = "SL"; break;
      case SfcQualifier::Entry:
      case SfcQualifier::Active:
      case SfcQualifier::Exit: continue;
    }
    if (!any) {
      open("actionBlock", ++next_id_);
      position(1, row_);
      wire(step_id_[i]);
    }
    any = true;
    open("action", ++next_id_);
    to_.xml.attribute("qualifier", word);
    if (a.time.value) to_.xml.attribute("duration", text(a.time));
    const std::span<const Ident> indicators = to_.tree.list(a.indicators);
    if (!indicators.empty()) to_.xml.attribute("indicator", to_.string(indicators[0].name));
    to_.xml.open("relPosition").attribute("x", "0").attribute("y", std::to_string(20 * row++)).close();
    if (const PouDecl* body = inline_actions_.find(a.action.name))
      body_(to_, *body, "inline");
    else
      to_.xml.open("reference").attribute("name", to_.string(a.action.name)).close();
    if (indicators.size() > 1) {
      AddData data(to_);
      data.openOwn();
      to_.xml.open("action");
      for (const Ident& more : indicators.subspan(1))
        to_.xml.open("indicator").attribute("name", to_.string(more.name)).close();
      to_.xml.close();
      data.close();
    }
    to_.xml.close();
  }
  if (any) to_.xml.close();
}

void ChartExport::step(uint32_t i) {
  const SfcStep& step = steps_[i];
  uint64_t from = into_[i].empty() ? 0 : into_[i][0];
  if (into_[i].size() > 1) {
    open("selectionConvergence", from = ++next_id_);
    position(0, row_++);
    for (const uint64_t id : into_[i]) wire(id);
    to_.xml.leaf("connectionPointOut");
    to_.xml.close();
  }
  open("step", step_id_[i]);
  size(step.position);
  to_.xml.attribute("name", to_.string(step.name.name));
  if (step.initial) to_.xml.attribute("initialStep", "true");
  position(step.position);
  if (from != 0) wire(from);
  to_.xml.open("connectionPointOut").attribute("formalParameter", "sfc").close();
  to_.xml.open("connectionPointOutAction").attribute("formalParameter", "").close();
  ownActions(step);
  to_.xml.close();
  actions(i);
  ++row_;
  if (uses_[i] < 2) return;
  open("selectionDivergence", source_id_[i]);
  position(0, row_++);
  wire(step_id_[i]);
  outputs(uses_[i]);
  to_.xml.close();
}

// An expression is written in the transition; a body, or a condition with a name that others use, among the transitions
// of the POU.
void ChartExport::condition(const SfcTransition& t) {
  to_.xml.open("condition");
  if (t.body && !t.name.name) {
    body_(to_, to_.tree.as<PouDecl>(t.body), "inline");
  } else if (t.condition.value && !t.body) {
    to_.xml.open("inline").attribute("name", "");
    to_.xml.formatted("ST", text(t.condition));
    to_.xml.close();
  } else {
    to_.xml.open("reference").attribute("name", to_.string(t.name.name)).close();
  }
  to_.xml.close();
}

void ChartExport::transition(uint32_t i) {
  const SfcTransition& t = transitions_[i];
  if (t.from.empty()) return;
  uint64_t from = source_id_[indexOf(to_.tree.list(t.from)[0])];
  if (t.from.count > 1) {
    open("simultaneousConvergence", ++next_id_);
    from = next_id_;
    position(0, row_++);
    for (const Ident& step : to_.tree.list(t.from)) wire(source_id_[indexOf(step)]);
    to_.xml.leaf("connectionPointOut");
    to_.xml.close();
  }
  open("transition", transition_id_[i]);
  size(t.position);
  if (t.has_priority) to_.xml.attribute("priority", std::to_string(t.priority));
  position(t.position);
  ++row_;
  wire(from);
  to_.xml.leaf("connectionPointOut");
  condition(t);
  if (t.name.name && t.condition.value && !t.body) {
    AddData data(to_);
    data.openOwn();
    to_.xml.open("transition").attribute("name", to_.string(t.name.name)).close();
    data.close();
  }
  to_.xml.close();
  if (split_id_[i] != 0) {
    open("simultaneousDivergence", split_id_[i]);
    position(0, row_++);
    wire(transition_id_[i]);
    outputs(t.to.count);
    to_.xml.close();
  }
  int column = 0;
  for (const Target& target : targets_[i]) {
    if (target.jumps) {
      open("jumpStep", ++next_id_);
      to_.xml.attribute("targetName", to_.string(steps_[target.step].name.name));
      position(column, row_);
      wire(split_id_[i] != 0 ? split_id_[i] : transition_id_[i]);
      to_.xml.close();
    }
    ++column;
  }
  ++row_;
}

// Comments of the chart itself; quoted parts include theirs.
void ChartExport::comments() {
  const SourceText& source = *to_.source;
  const size_t begin = source.commentsBefore(source.at(pou_.body_begin), true);
  for (const SourceText::Span& span : source.commentsIn(begin, source.endWithComments(source.at(pou_.body_end)))) {
    const auto holds = [&](Loc from, Loc end) { return source.at(from) <= span.begin && span.end <= source.at(end); };
    bool quoted = false;
    for (const DeclId member : to_.tree.list(pou_.members)) {
      if (to_.tree.kind(member) != DeclKind::Pou) continue;
      const auto& action = to_.tree.as<PouDecl>(member);
      quoted = quoted ||
               (source.commentsBefore(source.at(action.h.begin)) <= span.begin && span.end <= source.at(action.h.end));
    }
    for (const SfcTransition& t : transitions_)
      quoted = quoted || (t.condition.value && holds(t.condition.begin, t.condition.end));
    if (quoted) continue;
    open("comment", ++next_id_);
    to_.xml.attribute("height", "40").attribute("width", "160");
    position(2, row_++);
    to_.xml.formatted("content", source.comments(span.begin, span.end));
    to_.xml.close();
  }
}

void ChartExport::run() {
  plan();
  to_.xml.open("SFC");
  for (uint32_t i = 0; i < steps_.size(); ++i) step(i);
  for (uint32_t i = 0; i < transitions_.size(); ++i) transition(i);
  comments();
  to_.xml.close();
}

}  // namespace

void exportChart(Export& to, const PouDecl& pou, BodyExport body) { ChartExport(to, pou, body).run(); }

void exportTransitions(Export& to, const PouDecl& pou, BodyExport body) {
  bool any = false;
  for (const SfcTransition& t : to.tree.list(pou.transitions)) {
    if (!t.body || !t.name.name) continue;
    if (!any) to.xml.open("transitions");
    any = true;
    to.xml.open("transition").attribute("name", to.string(t.name.name));
    body(to, to.tree.as<PouDecl>(t.body), "body");
    to.xml.close();
  }
  if (any) to.xml.close();
}

}  // namespace rung::exporter
