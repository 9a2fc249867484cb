// SPDX-License-Identifier: Apache-2.0
// Charts as textual SFC: their steps and actions; see chart.h and import.h.
#include <algorithm>
#include <iterator>
#include <utility>

#include "frontend/import/plcopen/chart.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"
#include "frontend/syntax/inline_actions.h"

namespace rung::importer::plcopen {
namespace {

// Attributes of steps and actions in the addData of CODESYS, by the first digits of their GUID.
constexpr std::string_view kEntryAction = "a6b08bd8", kActiveAction = "700a583f", kExitAction = "a2621e18",
                           kMinimum = "cacf1a68", kMaximum = "b693554c";

bool isTimed(std::string_view qualifier) {
  for (const std::string_view word : {"L", "D", "SD", "DS", "SL"})
    if (sameIdentifier(word, qualifier)) return true;
  return false;
}

}  // namespace

const xml::Element* Chart::ownAttribute(const xml::Element& element, std::string_view guid) const {
  const xml::Element* attributes = dataOf(import_, element, "element");
  for (const xml::Element& e : document_.children(attributes))
    if (raw(e, "guid").starts_with(guid) && !isBlank(document_.text(e, import_.sources))) return &e;
  return nullptr;
}

// T#5s; some tools write `5s`.
void Chart::readTime(const xml::Element& action, StepAction& out) {
  const xml::Attribute* duration = document_.attribute(action, "duration");
  if (duration == nullptr || isBlank(duration->raw)) return;  // reported by the parser
  const std::string time = document_.decoded(*duration);
  if (time[0] >= '0' && time[0] <= '9') out.time_prefix = "T#";
  out.time = {document_, *duration};
}

// A file that Rung wrote may have an action of such a name.
std::string Chart::newActionNumber() {
  std::string number;
  do number = std::to_string(++import_.own_action_count);
  while (import_.action_names.count("SFC_ACTION_" + number) != 0);
  return number;
}

// The name of the action or variable, which may be that of an instance. An action with an inline body, or a variable
// that is not just names, gets an ACTION.
xml::Excerpt Chart::actionName(const xml::Element& action, const xml::Attribute* name) {
  if (name != nullptr && isPath(name->raw)) {
    xml::Excerpt excerpt(document_, *name);
    if (import_.isRenamed(name->raw)) excerpt.text = kActionSuffix;
    return excerpt;
  }
  std::string& own =
      own_actions_[name != nullptr ? upper(document_.decoded(*name)) : std::to_string(action.loc.offset)];
  if (own.empty()) {
    own = "sfc_action_" + newActionNumber();
    import_.own_actions.push_back({own, document_.child(action, "inline"), name});
  }
  return {action.loc, own};
}

// open(L, T#5s, busy);
void Chart::readAction(const xml::Element& action, ChartStep& step) {
  const xml::Element* reference = document_.child(action, "reference");
  if (reference == nullptr && document_.child(action, "inline") == nullptr) return;  // drawn, but not filled in yet
  if (reference != nullptr && !checkName(import_, *reference)) return;
  StepAction& out = step.actions.emplace_back();
  out.name = actionName(action, reference == nullptr ? nullptr : document_.attribute(*reference, "name"));
  const xml::Attribute* qualifier = document_.attribute(action, "qualifier");
  if (qualifier != nullptr && !isBlank(qualifier->raw)) {
    out.qualifier = {document_, *qualifier};
    if (isTimed(qualifier->raw)) readTime(action, out);
  }
  const xml::Attribute* indicator = document_.attribute(action, "indicator");
  if (indicator != nullptr && isIdentifier(indicator->raw)) out.indicators.push_back({document_, *indicator});
  // Exported by Rung; in other files an action has one indicator.
  for (const xml::Element& e : document_.children(dataOf(import_, action, "extension")))
    if (e.name == "indicator" && hasName(import_, e))
      out.indicators.push_back({document_, *document_.attribute(e, "name")});
}

void Chart::readActions(uint32_t node, ChartStep& step) {
  static constexpr std::pair<std::string_view, std::string_view> kOwn[] = {
      {kEntryAction, "entry"}, {kActiveAction, "active"}, {kExitAction, "exit"}};
  for (const auto& [guid, pragma] : kOwn) {
    const xml::Element* found = ownAttribute(*nodes_[node].element, guid);
    if (found == nullptr) continue;
    StepAction& action = step.actions.emplace_back();
    action.pragma = pragma;
    action.name = {document_, *found};
    if (import_.isRenamed(textOf(import_, *found))) action.name.text = kActionSuffix;
  }
  for (const uint32_t block : action_blocks_[node])
    for (const xml::Element& e : document_.children(*nodes_[block].element))
      if (e.name == "action") readAction(e, step);
}

// A limit of the time of a step: of CODESYS, or of Rung's export.
xml::Excerpt Chart::stepTime(const xml::Element& step, std::string_view guid, std::string_view attribute) const {
  if (const xml::Element* own = ownAttribute(step, guid)) return {document_, *own};
  const xml::Element* exported = dataOf(import_, step, "extension");
  if (exported == nullptr || !hasName(import_, *exported, attribute)) return {};
  return {document_, *document_.attribute(*exported, attribute)};
}

void Chart::writeStep(uint32_t node) {
  const xml::Element& element = *nodes_[node].element;
  ChartStep step;
  step.loc = element.loc;
  step.end = element.end;
  step.name = stepName(node);
  step.minimum = stepTime(element, kMinimum, "min");
  step.maximum = stepTime(element, kMaximum, "max");
  if (nodes_[node].kind == NodeKind::Step) {
    step.initial = isTrue(import_, element, "initialStep");
    // The content of a macro step is a separate drawing: such charts are laid out automatically.
    if (outer_ == nullptr && macros_.empty()) step.area = areaOf(document_, element);
    readActions(node, step);
  }
  writer_.write(step);
}

// A missing name was reported by readNodes().
xml::Excerpt Chart::stepName(uint32_t node) const {
  const xml::Element& element = *nodes_[node].element;
  if (nodes_[node].kind == NodeKind::Wait) return {element.loc, "sfc_wait_" + own_prefix_ + std::to_string(node)};
  const xml::Attribute* name =
      document_.attribute(element, nodes_[node].kind == NodeKind::Jump ? "targetName" : "name");
  return name == nullptr ? xml::Excerpt() : xml::Excerpt(document_, *name);
}

// A chart with an error in its graph is not written, to avoid follow-up errors.
void Chart::write() {
  connect();
  if (ok_) writeElements();
}

void Chart::writeElements() {
  auto macro = macros_.begin();
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].kind == NodeKind::Step || nodes_[i].kind == NodeKind::Wait) writeStep(i);
    if (nodes_[i].kind == NodeKind::MacroStep) writeMacro(*macro++);
    if (nodes_[i].kind == NodeKind::Transition) writeTransition(i);
  }
  // Conditions that Rung exported may name each other in their statements.
  if (import_.is_rung && outer_ == nullptr && name_.find('.') == std::string::npos)
    for (const xml::Element& e : document_.children(document_.child(pou_, "transitions")))
      if (e.name == "transition") define(document_.value(e, "name"), e);
  for (size_t i = 0; i < definitions_.size(); ++i) writeDefinition(definitions_[i]);
  writeStepFlags();
}

// Coils and variables in the chart that are wired to steps: an added step that is always active runs them after all
// other steps. IEC 61131-3 ed. 3 table 54, 3b.
void Chart::writeStepFlags() {
  std::vector<const xml::Element*> ends;
  for (const ChartNode& node : nodes_) {
    const bool writes = node.element->name == "coil" || node.element->name == "outVariable";
    if (writes && node.first_wire != node.end_wire) ends.push_back(node.element);
  }
  if (ends.empty()) return;
  const std::string number = newActionNumber();
  import_.out.put(ends[0]->loc, "INITIAL_STEP sfc_flags_" + number + ": sfc_action_" + number +
                                    "(N); END_STEP\nACTION sfc_action_" + number + ":\n");
  DrawnBody diagram{chart_, NetworkLanguage::Ladder};
  diagram.ends = ends;
  writeNetworks(import_, diagram);
  import_.out.put(ends[0]->loc, "END_ACTION\n");
}

void writeChart(Import& import, const xml::Element& chart, const xml::Element& pou, const std::string& name) {
  Chart(import, chart, pou, name).write();
}

// ACTION sfc_action_1: … END_ACTION for actions that cannot be written in a step.
void writeOwnActions(Import& import, const xml::Element& pou, const std::string& name) {
  for (size_t i = 0; i < import.own_actions.size(); ++i) {  // a chart in an action adds its own
    const OwnAction action = import.own_actions[i];
    const Loc loc = action.body != nullptr ? action.body->loc : action.variable->loc;
    if (action.body != nullptr) import.out.put(loc, "{" + std::string(kInlineAction) + "}\n");
    import.out.put(loc, "ACTION " + action.name + " :\n");
    if (action.body != nullptr) {
      writeBody(import, *action.body, pou, name + "." + action.name);
    } else {
      import.out.add(import.document, *action.variable);
      import.out.word(" := _" + action.name + "._x;\n");
    }
    import.out.word("END_ACTION\n");
  }
  import.own_actions.clear();
}

// <SFCInit Declare="true" Use="true"/>, or <Init …/>. The chart uses the variables only if they are declared.
void writeFlags(Import& import, const xml::Element& owner) {
  const xml::Element* settings = dataOf(import, owner, "sfcsettings");
  const xml::Element* flags = settings == nullptr ? nullptr : import.document.child(*settings, "Flags");
  for (const xml::Element& e : import.document.children(flags)) {
    if (!isTrue(import, e, "Use")) continue;
    const std::string_view name = e.name.starts_with("SFC") ? e.name.substr(3) : e.name;
    if (!declares(import, owner, "SFC" + std::string(name))) import.out.put(e.loc, declarationOfFlag(name));
  }
}

}  // namespace rung::importer::plcopen
