// SPDX-License-Identifier: Apache-2.0
// Charts of TwinCAT; see archive.h. A chart is a sequence of steps, transitions, jumps and branches, whose lines are
// sequences again. It becomes textual SFC, with the steps before and after each transition.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "frontend/import/chart_writer.h"
#include "frontend/import/diagnostics.h"
#include "frontend/import/twincat/archive.h"
#include "frontend/source/names.h"
#include "frontend/source/scanner.h"

namespace rung::importer::twincat {
namespace {

// The attributes of elements, by the first digits of their GUID.
constexpr std::string_view kName = "{38391c6d", kInitial = "{6844a48e", kMain = "{700a583f", kEntry = "{a6b08bd8",
                           kExit = "{a2621e18", kParallel = "{23bdaa98", kQualifier = "{e174fc0d",
                           kMinimumTime = "{cacf1a68", kMaximumTime = "{b693554c";
constexpr size_t kMaxPaths = 10'000;  // sets of steps before one transition

using Steps = std::vector<const Element*>;

struct Transition {
  const Element* element;
  std::vector<Steps> from;
  Steps to;
};
// The predecessors of the next element: sets of steps, or transitions without a target yet.
struct Front {
  std::vector<Steps> steps;
  std::vector<size_t> transitions;
  bool begins = false;  // at the start of the chart: any element is allowed
};

const Element* attributeOf(const Archive& archive, const Element& element, std::string_view guid) {
  for (const xml::Element& e : archive.items(archive.member(element, "Attributes"))) {
    if (!archive.text(e, "AttributeId").starts_with(guid)) continue;
    const Element* value = archive.member(e, "Value");
    const Element* text = value == nullptr ? nullptr : archive.member(*value, "Value");
    return text != nullptr && !archive.text(*text).empty() ? text : nullptr;
  }
  return nullptr;
}

bool isSet(const Archive& archive, const Element& element, std::string_view guid) {
  const Element* value = attributeOf(archive, element, guid);
  return value != nullptr && sameIdentifier(archive.text(*value), "TRUE");
}

const Element* innerList(const Archive& archive, const Element& owner) {
  const Element* list = archive.member(owner, "ElementList");
  return list == nullptr ? nullptr : archive.member(*list, "InnerList");
}

template <class Visit>
void forEachStep(const Archive& archive, const Element& segment, Visit visit) {
  for (const xml::Element& e : archive.items(innerList(archive, segment))) {
    const std::string type = archive.typeOf(e);
    if (type == "SFCStep") {
      visit(e);
    } else if (type == "SFCBranch" || type == "SFCSegment") {
      forEachStep(archive, e, visit);
    } else if (type == "SFCMacro") {
      if (const Element* inner = archive.member(e, "Segment")) forEachStep(archive, *inner, visit);
    }
  }
}

const Element* rootOf(const Archive& archive, const Element& body) {
  const Element* object = archive.root(body, "SFCImplementationObject");
  return object == nullptr ? nullptr : archive.member(*object, "Root");
}

class ChartReader {
 public:
  explicit ChartReader(const ArchivedBody& body)
      : archive_(body.archive), name_(body.name), diagnostics_(body.diagnostics), out_(body.out), writer_(body.out) {}

  void run(const Element& root);

 private:
  template <class... Args>
  void report(Diag diag, Loc loc, Args... args) {
    ok_ = false;
    diagnostics_.report(diag, loc, {args...});
  }
  std::string called(const Element& element) const;
  std::string before(const Front& front) const;
  Loc locOf(const Element& element) const;
  void walk(const Element& segment, Front& front);
  void step(const Element& element, Front& front);
  void transition(const Element& element, Front& front);
  void jump(const Element& element, Front& front);
  void branch(const Element& element, Front& front);
  void writeStep(const Element& element);
  void writeTransition(const Transition& transition);
  xml::Excerpt actionName(const Element& name) const;
  std::vector<xml::Excerpt> namesOf(const Steps& steps) const;
  bool isStep(std::string_view name) const {
    return std::any_of(steps_.begin(), steps_.end(), [&](const Element* e) {
      const Element* own = attributeOf(archive_, *e, kName);
      return own != nullptr && sameIdentifier(archive_.text(*own), name);
    });
  }

  const Archive& archive_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  xml::SourceMappedText& out_;
  ChartWriter writer_;
  bool ok_ = true;
  Steps steps_;
  std::vector<Transition> transitions_;
  std::vector<std::pair<bool, size_t>> written_;  // in chart order: a step, or a transition
};

std::string ChartReader::called(const Element& element) const {
  const std::string type = archive_.typeOf(element);
  const Element* name = attributeOf(archive_, element, kName);
  const std::string of = name == nullptr ? "" : " `" + archive_.text(*name) + "`";
  return (type == "SFCStep" ? "step" : type == "SFCJump" ? "the jump to" : "the transition") + of;
}

std::string ChartReader::before(const Front& front) const {
  if (!front.transitions.empty()) return called(*transitions_[front.transitions[0]].element);
  return front.steps.empty() || front.steps[0].empty() ? "a jump" : called(*front.steps[0][0]);
}

Loc ChartReader::locOf(const Element& element) const {
  const Element* name = attributeOf(archive_, element, kName);
  return name == nullptr ? element.loc : archive_.locOf(*name);
}

// Forbids a step directly after a step.
//   fails   SFCStep SFCStep          E1091
void ChartReader::step(const Element& element, Front& front) {
  if (attributeOf(archive_, element, kName) == nullptr) return report(diag::ArchiveNoName, element.loc, "step");
  if (!front.steps.empty()) return report(diag::ChartNoTransition, locOf(element), before(front), called(element));
  for (const size_t t : front.transitions) transitions_[t].to.push_back(&element);
  steps_.push_back(&element);
  written_.emplace_back(true, steps_.size() - 1);
  front = {{{&element}}, {}, false};
}

// Forbids a transition directly after a transition, and one without a condition.
//   fails   SFCTransition SFCTransition                              E1063
//   fails   an SFCTransition whose name, its condition, is empty     E1066
void ChartReader::transition(const Element& element, Front& front) {
  if (attributeOf(archive_, element, kName) == nullptr) return report(diag::ChartNoCondition, element.loc);
  if (!front.transitions.empty() || (front.steps.empty() && front.begins))
    return report(diag::ChartNoStepBetween, locOf(element),
                  front.transitions.empty() ? std::string("the beginning") : before(front), called(element));
  transitions_.push_back({&element, front.steps, {}});
  written_.emplace_back(false, transitions_.size() - 1);
  front = {{}, {transitions_.size() - 1}, false};
}

// Forbids a jump to an undefined step, and one directly after a step.
//   fails   SFCStep SFCJump          E1091
void ChartReader::jump(const Element& element, Front& front) {
  if (attributeOf(archive_, element, kName) == nullptr) return report(diag::ArchiveNoName, element.loc, "jump");
  if (!front.steps.empty()) return report(diag::ChartNoTransition, locOf(element), before(front), called(element));
  for (const size_t t : front.transitions) transitions_[t].to.push_back(&element);
  front = {};
}

// Alternative lines, each with a transition; or parallel lines, each beginning with a step.
void ChartReader::branch(const Element& element, Front& front) {
  const bool parallel = isSet(archive_, element, kParallel);
  const Front incoming = front;
  front = {};
  std::vector<Steps> united = {{}};
  for (const Element& e : archive_.items(innerList(archive_, element))) {
    Front line = incoming;
    walk(e, line);
    if (!ok_) return;
    if (!parallel) {
      front.steps.insert(front.steps.end(), line.steps.begin(), line.steps.end());
      front.transitions.insert(front.transitions.end(), line.transitions.begin(), line.transitions.end());
      if (front.steps.size() > kMaxPaths) return report(diag::ChartTooManyWays, element.loc);
      continue;
    }
    if (!line.transitions.empty())
      return report(diag::ChartNoStepBetween, element.end, before(line), std::string("the end of a parallel branch"));
    if (line.steps.empty())
      diagnostics_.report(diag::ChartNeverConverges, element.end, {"a jump", "the parallel branch"});
    if (line.steps.size() * united.size() > kMaxPaths) return report(diag::ChartTooManyWays, element.loc);
    std::vector<Steps> all;
    for (const Steps& one : united)
      for (const Steps& other : line.steps) {
        all.push_back(one);
        all.back().insert(all.back().end(), other.begin(), other.end());
      }
    united = std::move(all);
  }
  if (parallel && united != std::vector<Steps>{{}}) front.steps = std::move(united);
}

//   fails   <o t="SFCCloud">          E1087
void ChartReader::walk(const Element& segment, Front& front) {
  for (const Element& e : archive_.items(innerList(archive_, segment))) {
    if (!ok_) return;
    if (Archive::isNothing(e)) continue;
    const std::string type = archive_.typeOf(e);
    if (type == "SFCStep") {
      step(e, front);
    } else if (type == "SFCTransition") {
      transition(e, front);
    } else if (type == "SFCJump") {
      jump(e, front);
    } else if (type == "SFCBranch") {
      branch(e, front);
    } else if (type == "SFCMacro") {  // its elements run in its place
      if (const Element* inner = archive_.member(e, "Segment")) walk(*inner, front);
    } else {
      archive_.reportObject(diagnostics_, e, "SFC", name_);
      ok_ = false;
    }
  }
}

xml::Excerpt ChartReader::actionName(const Element& name) const {
  xml::Excerpt excerpt = archive_.excerptOf(name);
  if (isStep(archive_.text(name))) excerpt.text = kActionSuffix;
  return excerpt;
}

void ChartReader::writeStep(const Element& element) {
  ChartStep step;
  step.loc = element.loc;
  step.end = element.end;
  step.initial = isSet(archive_, element, kInitial);
  step.name = archive_.excerptOf(*attributeOf(archive_, element, kName));
  if (const Element* time = attributeOf(archive_, element, kMinimumTime)) step.minimum = archive_.excerptOf(*time);
  if (const Element* time = attributeOf(archive_, element, kMaximumTime)) step.maximum = archive_.excerptOf(*time);
  static constexpr std::pair<std::string_view, std::string_view> kOwn[] = {
      {kEntry, "entry"}, {kMain, "active"}, {kExit, "exit"}};
  for (const auto& [guid, pragma] : kOwn)
    if (const Element* action = attributeOf(archive_, element, guid))
      step.actions.push_back({pragma, actionName(*action), {}, {}, {}, {}});
  for (const Element& e : archive_.items(innerList(archive_, element))) {
    const Element* action = attributeOf(archive_, e, kName);
    const Element* qualifier = attributeOf(archive_, e, kQualifier);
    if (action == nullptr) continue;
    StepAction& out = step.actions.emplace_back();
    out.name = actionName(*action);
    if (qualifier == nullptr) continue;
    const std::string how = archive_.text(*qualifier);  // `D T#50ms`
    const size_t blank = how.find(' ');
    out.qualifier = {qualifier->loc, how.substr(0, blank)};
    if (blank != std::string::npos) out.time = xml::Excerpt(how.substr(blank + 1));
  }
  writer_.write(step);
}

std::vector<xml::Excerpt> ChartReader::namesOf(const Steps& steps) const {
  std::vector<xml::Excerpt> names;
  for (const Element* step : steps) names.push_back(archive_.excerptOf(*attributeOf(archive_, *step, kName)));
  return names;
}

// A TRANSITION for each set of steps from which it can fire.
void ChartReader::writeTransition(const Transition& transition) {
  for (const Steps& from : transition.from) {
    ChartTransition out;
    out.loc = transition.element->loc;
    out.from = namesOf(from);
    out.to = namesOf(transition.to);
    writer_.beginTransition(out);
    out_.word(" := ");
    out_.add(archive_.excerptOf(*attributeOf(archive_, *transition.element, kName)));
    out_.word("\n;");
    writer_.endTransition(transition.element->end);
  }
}

// Forbids a transition without a successor. A chart with an error is not written, to avoid follow-up errors.
//   fails   SFCStep SFCTransition          E1065
void ChartReader::run(const Element& root) {
  Front front;
  front.begins = true;
  walk(root, front);
  for (const Transition& t : transitions_)
    if (ok_ && t.to.empty()) report(diag::ChartLeadsNowhere, locOf(*t.element), called(*t.element));
  if (!ok_) return;
  for (const auto& [is_step, at] : written_) {
    if (is_step)
      writeStep(*steps_[at]);
    else
      writeTransition(transitions_[at]);
  }
}

}  // namespace

void writeSfc(const ArchivedBody& body) {
  if (const xml::Element* root = body.archive.member(body.object, "Root"))
    ChartReader(body).run(*root);
  else
    body.diagnostics.report(diag::ArchiveEmpty, body.object.loc, {body.name, "SFCImplementationObject"});
}

bool hasStep(const Archive& archive, const xml::Element& body, std::string_view name) {
  const xml::Element* root = rootOf(archive, body);
  bool found = false;
  if (root != nullptr)
    forEachStep(archive, *root, [&](const xml::Element& step) {
      const xml::Element* own = attributeOf(archive, step, kName);
      found = found || (own != nullptr && sameIdentifier(archive.text(*own), name));
    });
  return found;
}

// <d2 n="Flags"> <v>Init</v> <o> <v n="Use">true</v> … The chart uses the variables only if they are declared.
// Warns of a flag that is declared twice. CODESYS, "Dialog: Properties: SFC Settings".
//   warns   VAR SFCInit : BOOL; END_VAR, and `Declare` in the settings          W0844
void writeSfcFlags(const Archive& archive, const xml::Element& owner, std::vector<DeclaredFlag>& declared,
                   Diagnostics& diagnostics, xml::SourceMappedText& out) {
  const xml::Element* properties = archive.document().child(owner, "ObjectProperties");
  const xml::Element* settings = properties == nullptr ? nullptr : archive.root(*properties, "SFCProperty");
  if (settings == nullptr || archive.isTrue(*settings, "UseDefaults")) return;
  const xml::Element* key = nullptr;
  for (const xml::Element& e : archive.items(archive.member(*settings, "Flags"))) {
    if (e.name == "v") {
      key = &e;
      continue;
    }
    const std::string flag = key == nullptr ? std::string() : archive.text(*key);
    if (flag == "ErrorAnalyzation" || !archive.isTrue(e, "Use") || !archive.isTrue(e, "Declare")) continue;
    const std::string name = upper("SFC" + flag);
    const auto known =
        std::find_if(declared.begin(), declared.end(), [&](const DeclaredFlag& each) { return each.name == name; });
    if (known == declared.end()) {
      out.put(e.loc, declarationOfFlag(flag));
      declared.push_back({name, false});
    } else if (known->by_user) {
      diagnostics.report(diag::SfcFlagTwice, archive.locOf(*key), {"SFC" + flag})
          .length(static_cast<uint32_t>(flag.size()));
    }
  }
}

}  // namespace rung::importer::twincat
