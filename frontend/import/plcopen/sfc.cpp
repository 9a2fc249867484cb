// Charts as textual SFC: their steps and actions; see chart.h and import.h.
#include <algorithm>
#include <iterator>
#include <utility>

#include "frontend/import/plcopen/chart.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"

namespace rung::plcopen {
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
  for (const xml::Element* e = attributes == nullptr ? nullptr : document_.firstChild(*attributes); e != nullptr;
       e = document_.next(*e))
    if (raw(*e, "guid").starts_with(guid) && !isBlank(document_.text(*e, import_.sources))) return e;
  return nullptr;
}

// `, T#5s`; some tools write `5s`.
void Chart::writeTime(const xml::Element& action, std::string_view qualifier) {
  if (!isTimed(qualifier)) return;
  const xml::Attribute* duration = document_.attribute(action, "duration");
  if (duration == nullptr || isBlank(duration->raw)) return;  // reported by the parser
  const std::string time = document_.decoded(*duration);
  import_.out.put(duration->loc, time[0] >= '0' && time[0] <= '9' ? ", T#" : ", ");
  import_.out.add(document_, *duration);
}

// open(L, T#5s, busy); an action with an inline body, or a variable that is not just a name, gets an ACTION.
void Chart::writeAction(const xml::Element& action) {
  const xml::Element* reference = document_.child(action, "reference");
  const xml::Element* inline_body = document_.child(action, "inline");
  if (reference == nullptr && inline_body == nullptr) return;  // drawn, but not filled in yet
  if (reference != nullptr && !checkName(import_, *reference)) return;
  const xml::Attribute* name = reference == nullptr ? nullptr : document_.attribute(*reference, "name");
  if (name != nullptr && isIdentifier(name->raw)) {
    import_.out.add(document_, *name);
    if (import_.isRenamed(name->raw)) import_.out.word(kActionSuffix);
  } else {
    std::string& own =
        own_actions_[name != nullptr ? upper(document_.decoded(*name)) : std::to_string(action.loc.offset)];
    if (own.empty()) {
      own = "sfc_action_" + std::to_string(++import_.own_action_count);
      import_.own_actions.push_back({own, inline_body, name});
    }
    import_.out.put(action.loc, own);
  }
  const xml::Attribute* qualifier = document_.attribute(action, "qualifier");
  import_.out.word("(");
  if (qualifier == nullptr || isBlank(qualifier->raw)) {
    import_.out.word("N");
  } else {
    import_.out.add(document_, *qualifier);
    writeTime(action, qualifier->raw);
  }
  const xml::Attribute* indicator = document_.attribute(action, "indicator");
  if (indicator != nullptr && isIdentifier(indicator->raw)) {
    import_.out.put(indicator->loc, ", ");
    import_.out.add(document_, *indicator);
  }
  // Exported by Rung; in other files an action has one indicator.
  const xml::Element* own = dataOf(import_, action, "extension");
  for (const xml::Element* e = own == nullptr ? nullptr : document_.firstChild(*own); e != nullptr;
       e = document_.next(*e)) {
    if (e->name != "indicator" || !hasName(import_, *e)) continue;
    import_.out.put(e->loc, ", ");
    writeName(import_, *e);
  }
  import_.out.word(");\n");
}

void Chart::writeStepActions(uint32_t node) {
  static constexpr std::pair<std::string_view, std::string_view> kOwn[] = {
      {kEntryAction, "{entry} "}, {kActiveAction, "{active} "}, {kExitAction, "{exit} "}};
  for (const auto& [guid, pragma] : kOwn) {
    const xml::Element* found = ownAttribute(*nodes_[node].element, guid);
    if (found == nullptr) continue;
    import_.out.put(found->loc, pragma);
    import_.out.add(document_, *found);
    if (import_.isRenamed(textOf(import_, *found))) import_.out.word(kActionSuffix);
    import_.out.word(";\n");
  }
  for (const uint32_t block : action_blocks_[node])
    for (const xml::Element* e = document_.firstChild(*nodes_[block].element); e != nullptr; e = document_.next(*e))
      if (e->name == "action") writeAction(*e);
}

// (TMIN := T#1s, TMAX := limit): of CODESYS and of Rung's export.
void Chart::writeStepTimes(const xml::Element& step) {
  const xml::Element* exported = dataOf(import_, step, "extension");
  const char* before = " (";
  struct Time {
    const char* attribute;
    std::string_view guid;
    const char* word;
  };
  for (const auto& [attribute, guid, word] : {Time{"min", kMinimum, "TMIN := "}, Time{"max", kMaximum, "TMAX := "}}) {
    const xml::Element* own = ownAttribute(step, guid);
    if (own == nullptr && (exported == nullptr || !hasName(import_, *exported, attribute))) continue;
    import_.out.put(own == nullptr ? exported->loc : own->loc, before + std::string(word));
    if (own == nullptr)
      import_.out.add(document_, *document_.attribute(*exported, attribute));
    else
      import_.out.add(document_, *own);
    before = ", ";
  }
  if (before[0] == ',') import_.out.word(")");
}

// STEP name: actions END_STEP
void Chart::writeStep(uint32_t node) {
  const xml::Element& step = *nodes_[node].element;
  const bool is_initial = nodes_[node].kind == NodeKind::Step && isTrue(import_, step, "initialStep");
  import_.out.put(step.loc, is_initial ? "INITIAL_STEP " : "STEP ");
  writeStepName(node);
  if (nodes_[node].kind == NodeKind::Step) writePosition(step);
  writeStepTimes(step);
  import_.out.word(":\n");
  if (nodes_[node].kind == NodeKind::Step) writeStepActions(node);
  import_.out.put(step.end, "END_STEP\n");
}

// The content of a macro step is a separate drawing: such charts are laid out automatically.
void Chart::writePosition(const xml::Element& element) {
  if (outer_ != nullptr || !macros_.empty()) return;
  if (const std::string position = positionOf(document_, element); !position.empty())
    import_.out.put(element.loc, position);
}

void Chart::writeStepName(uint32_t node) {
  const xml::Element& element = *nodes_[node].element;
  if (nodes_[node].kind == NodeKind::Wait)
    import_.out.put(element.loc, "sfc_wait_" + own_prefix_ + std::to_string(node));
  else
    writeName(import_, element, nodes_[node].kind == NodeKind::Jump ? "targetName" : "name");
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
  const std::string number = std::to_string(++import_.own_action_count);
  import_.out.put(ends[0]->loc, "INITIAL_STEP sfc_flags_" + number + ": sfc_action_" + number +
                                    "(N); END_STEP\nACTION sfc_action_" + number + ":\n");
  DrawnBody diagram{chart_, NetworkLanguage::Ladder};
  diagram.ends = ends;
  writeNetworks(import_.sources, document_, diagram, import_.out);
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
  static constexpr std::pair<std::string_view, std::string_view> kFlags[] = {
      {"Init", "VAR_INPUT SFCInit : BOOL"},
      {"Reset", "VAR_INPUT SFCReset : BOOL"},
      {"QuitError", "VAR_INPUT SFCQuitError : BOOL"},
      {"Pause", "VAR_INPUT SFCPause : BOOL"},
      {"Tip", "VAR_INPUT SFCTip : BOOL"},
      {"TipMode", "VAR_INPUT SFCTipMode : BOOL"},
      {"EnableLimit", "VAR_INPUT SFCEnableLimit : BOOL"},
      {"Error", "VAR_OUTPUT SFCError : BOOL"},
      {"Trans", "VAR_OUTPUT SFCTrans : BOOL"},
      {"ErrorStep", "VAR_OUTPUT SFCErrorStep : STRING"},
      {"ErrorPOU", "VAR_OUTPUT SFCErrorPOU : STRING"},
      {"CurrentStep", "VAR_OUTPUT SFCCurrentStep : STRING"},
      {"ErrorAnalyzation", "VAR_OUTPUT SFCErrorAnalyzation : STRING"}};
  const xml::Element* settings = dataOf(import, owner, "sfcsettings");
  const xml::Element* flags = settings == nullptr ? nullptr : import.document.child(*settings, "Flags");
  for (const xml::Element* e = flags == nullptr ? nullptr : import.document.firstChild(*flags); e != nullptr;
       e = import.document.next(*e)) {
    if (!isTrue(import, *e, "Use")) continue;
    const std::string_view name = e->name.starts_with("SFC") ? e->name.substr(3) : e->name;
    for (const auto& [flag, declaration] : kFlags)
      if (name == flag && !declares(import, owner, "SFC" + std::string(flag)))
        import.out.put(e->loc, std::string(declaration) + "; END_VAR\n");
  }
}

}  // namespace rung::plcopen
