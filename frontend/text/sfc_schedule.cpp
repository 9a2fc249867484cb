// Writes a chart as declarations and statements; see sfc_schedule.h. The statements of a cycle, in this order
// (TM/TP manual 5.5; iec-syntax 5.9.8):
//   1. flags: SFCInit, SFCReset, SFCQuitError, SFCPause
//   2. steps that were left: exit actions; steps that were entered: entry actions
//   3. active steps: times, limits, active actions, qualifiers of their actions
//   4. control blocks, boolean variables and final scans; then the actions that are active
//   5. transitions of active steps: the first that fires, in the order of priority, then of the text
#include "frontend/text/sfc_schedule.h"

#include <algorithm>
#include <functional>
#include <string>

namespace rung::text {

StepIndex::StepIndex(const Charts& charts, const PouDecl& pou) : names_(charts.names), count_(pou.steps.count) {
  const std::span<const SfcStep> steps = charts.tree.list(pou.steps);
  for (uint32_t i = 0; i < steps.size(); ++i) by_name_.push_back({names_.key(steps[i].name.name).index, i});
  std::sort(by_name_.begin(), by_name_.end());
}

uint32_t StepIndex::of(NameId name) const {
  const uint32_t key = names_.key(name).index;
  const auto found = std::lower_bound(by_name_.begin(), by_name_.end(), std::pair<uint32_t, uint32_t>{key, 0});
  return found != by_name_.end() && found->first == key ? found->second : count_;
}

namespace {

constexpr uint32_t kWord = 64;  // bits of a set's word
constexpr size_t kTextLength = 80;

const char* wordOf(SfcQualifier q) {
  switch (q) {
    case SfcQualifier::N: return "N";
    case SfcQualifier::R: return "R";
    case SfcQualifier::S: return "S";
    case SfcQualifier::L: return "L";
    case SfcQualifier::D: return "D";
    case SfcQualifier::P: return "P";
    case SfcQualifier::P0: return "P0";
    case SfcQualifier::P1: return "P1";
    case SfcQualifier::SD: return "SD";
    case SfcQualifier::DS: return "DS";
    case SfcQualifier::SL: return "SL";
    case SfcQualifier::Entry:
    case SfcQualifier::Active:
    case SfcQualifier::Exit: break;
  }
  return "";
}
bool isControlled(SfcQualifier q) { return q < SfcQualifier::Entry; }

std::string literalOf(uint64_t word) {
  static const char* const kHex = "0123456789ABCDEF";
  std::string digits;
  do digits.insert(digits.begin(), kHex[word & 15]);
  while ((word >>= 4) != 0);
  return "LWORD#16#" + digits;
}
std::string maskOf(uint32_t index) { return literalOf(uint64_t{1} << (index % kWord)); }

// A text in ST of which each byte knows its place in the chart.
class Writer {
 public:
  Writer(const Charts& charts, Loc place) : charts_(charts), place_(place) {}

  void at(Loc place) { place_ = place; }
  template <class... Parts>
  void line(uint32_t depth, const Parts&... parts) {
    if (depth > 0) put(std::string(2 * depth, ' '));
    (put(parts), ...);
    put("\n");
  }
  void put(std::string_view text) {
    if (segments_.empty() || segments_.back().verbatim || segments_.back().from != place_)
      segments_.push_back({static_cast<uint32_t>(text_.size()), place_, false});
    text_ += text;
  }
  void put(const Ident& name) { put(charts_.names.text(name.name)); }
  void put(const SfcExpr& quoted) {
    segments_.push_back({static_cast<uint32_t>(text_.size()), quoted.begin, true});
    text_ += textOf(quoted);
  }
  std::string_view textOf(const SfcExpr& e) const {
    const FileId file = charts_.sources.fileOf(e.begin);
    return charts_.sources.text(file).substr(e.begin.offset - charts_.sources.begin(file).offset,
                                             e.end.offset - e.begin.offset);
  }
  bool empty() const { return text_.empty(); }
  FileId finish() {
    const FileId file = charts_.sources.fileOf(place_);
    if (segments_.empty()) segments_.push_back({0, place_, false});
    const FileId made =
        charts_.sources.addAssembled(std::string(charts_.sources.path(file)), std::move(text_), std::move(segments_));
    if (made) charts_.sources.showAs(made, std::string(charts_.sources.shown(file)));
    return made;
  }

 private:
  const Charts& charts_;
  Loc place_;
  std::string text_;
  std::vector<Segment> segments_;
};

// What both parts of the schedule know of a chart.
class Chart {
 public:
  Chart(const Charts& charts, const PouDecl& pou);

  std::string_view text(NameId name) const { return charts_.names.text(name); }
  std::string_view name(uint32_t step) const { return text(steps_[step].name.name); }
  uint32_t words(size_t count) const { return static_cast<uint32_t>((count + kWord - 1) / kWord); }
  uint32_t actionOf(NameId name) const;
  const Ident* flag(std::string_view word) const;  // a variable of the POU that charts give a meaning
  std::string initialSteps() const;                // the words of their set
  bool keepsCondition(const SfcTransition& t) const { return t.body || (t.name.name && t.condition.value); }

  const Charts& charts_;
  const PouDecl& pou_;
  std::span<const SfcStep> steps_;
  std::span<const SfcTransition> transitions_;
  StepIndex index_;
  std::vector<Ident> actions_;  // with control blocks, in the order of their first association
  std::vector<std::pair<uint32_t, uint32_t>> action_by_name_;
};

Chart::Chart(const Charts& charts, const PouDecl& pou)
    : charts_(charts),
      pou_(pou),
      steps_(charts.tree.list(pou.steps)),
      transitions_(charts.tree.list(pou.transitions)),
      index_(charts, pou) {
  for (const SfcStep& step : steps_)
    for (const SfcAssociation& a : charts_.tree.list(step.actions))
      if (isControlled(a.qualifier)) {
        action_by_name_.push_back(
            {charts_.names.key(a.action.name).index, static_cast<uint32_t>(action_by_name_.size())});
        actions_.push_back(a.action);
      }
  // The first association of each name remains.
  std::sort(action_by_name_.begin(), action_by_name_.end());
  std::vector<bool> kept(actions_.size());
  for (size_t i = 0; i < action_by_name_.size(); ++i)
    kept[action_by_name_[i].second] = i == 0 || action_by_name_[i].first != action_by_name_[i - 1].first;
  std::vector<Ident> actions;
  std::vector<std::pair<uint32_t, uint32_t>> by_name;
  for (size_t i = 0; i < actions_.size(); ++i) {
    if (!kept[i]) continue;
    by_name.push_back({charts_.names.key(actions_[i].name).index, static_cast<uint32_t>(actions.size())});
    actions.push_back(actions_[i]);
  }
  std::sort(by_name.begin(), by_name.end());
  actions_ = std::move(actions);
  action_by_name_ = std::move(by_name);
}

uint32_t Chart::actionOf(NameId name) const {
  const uint32_t key = charts_.names.key(name).index;
  return std::lower_bound(action_by_name_.begin(), action_by_name_.end(), std::pair<uint32_t, uint32_t>{key, 0})
      ->second;
}

std::string Chart::initialSteps() const {
  std::string list;
  for (uint32_t first = 0; first < steps_.size(); first += kWord) {
    uint64_t word = 0;
    for (uint32_t i = first; i < steps_.size() && i < first + kWord; ++i)
      if (steps_[i].initial) word |= uint64_t{1} << (i % kWord);
    list += (list.empty() ? "" : ", ") + literalOf(word);
  }
  return list;
}

const Ident* Chart::flag(std::string_view word) const {
  const Tree& tree = charts_.tree;
  for (const DeclId section : tree.list(pou_.sections))
    for (const DeclId var : tree.list(tree.as<SectionDecl>(section).vars))
      for (const Ident& name : tree.list(tree.as<VarDecl>(var).names))
        if (sameIdentifier(text(name.name), word)) return &name;
  return nullptr;
}

// ---- the variables

void writeSections(const Chart& chart, Writer& out, bool final_scan) {
  const auto set = [&](const char* name, size_t count, std::string_view initial) {
    const uint32_t words = chart.words(count);
    if (words <= 1)
      out.line(1, name, " : LWORD", initial.empty() ? "" : " := ", initial, ";");
    else
      out.line(1, name, " : ARRAY[0..", std::to_string(words - 1), "] OF LWORD", initial.empty() ? "" : " := [",
               initial, initial.empty() ? ";" : "];");
  };
  out.line(0, "VAR");
  for (uint32_t i = 0; i < chart.steps_.size(); ++i) {
    const SfcStep& step = chart.steps_[i];
    out.at(step.name.loc);
    out.line(1, step.name, " : SFCStepType;");
  }
  for (const Ident& action : chart.actions_) {
    out.at(action.loc);
    out.line(1, "_", action, " : SFCActionControl", final_scan ? ";" : " := (final_scan := FALSE);");
  }
  for (size_t i = 0; i < chart.transitions_.size(); ++i) {
    const SfcTransition& t = chart.transitions_[i];
    if (!chart.keepsCondition(t)) continue;
    out.at(t.target.loc);
    out.line(1, t.target, " : BOOL;");
  }
  out.at(chart.pou_.body_begin);
  set("sfc_steps", chart.steps_.size(), "");
  set("sfc_left", chart.steps_.size(), "");
  set("sfc_entered", chart.steps_.size(), chart.initialSteps());
  if (!chart.actions_.empty()) set("sfc_actions", chart.actions_.size(), "");
  out.line(1, "sfc_fired : BOOL := TRUE;");
  if (chart.flag("SFCTipMode") != nullptr) out.line(1, "sfc_tip, sfc_tip_before : BOOL;");
  out.line(0, "END_VAR");
  out.line(0, "VAR_TEMP");
  out.line(1, "sfc_now : TIME;");
  out.line(1, "sfc_set : LWORD;");
  if (chart.words(chart.steps_.size()) > 1 || chart.words(chart.actions_.size()) > 1) out.line(1, "sfc_word : INT;");
  out.line(0, "END_VAR");
}

// ---- the statements

class Scheduler {
 public:
  Scheduler(const Chart& chart, Shapes& shapes, Writer& out)
      : chart_(chart), charts_(chart.charts_), tree_(chart.charts_.tree), shapes_(shapes), out_(out) {}

  void run();

 private:
  using Branch = std::function<void(uint32_t index, uint32_t depth)>;

  std::string word(const char* set, size_t count, uint32_t index) const {
    return chart_.words(count) <= 1 ? set : std::string(set) + "[" + std::to_string(index / kWord) + "]";
  }
  std::string stepWord(const char* set, uint32_t step) const { return word(set, chart_.steps_.size(), step); }
  // All words of a set.
  void forWords(uint32_t depth, size_t count,
                const std::function<void(const std::string& index, uint32_t depth)>& body);
  // Visits the set bits of a set: `wanted` says which have a branch.
  void scan(uint32_t depth, const char* set, size_t count, const std::function<bool(uint32_t)>& wanted,
            const std::function<std::string_view(uint32_t)>& name, const Branch& branch);
  std::function<std::string_view(uint32_t)> stepNames() const {
    return [this](uint32_t i) { return chart_.name(i); };
  }
  std::function<std::string_view(uint32_t)> actionNames() const {
    return [this](uint32_t i) { return chart_.text(chart_.actions_[i].name); };
  }
  bool callsAction(const Ident& action) const { return shapes_.of(action.name).kind != ShapeKind::Value; }
  void run(uint32_t depth, const SfcStep& step, SfcQualifier when);
  void flags();
  void reset(uint32_t depth);
  void evolve();
  void activeStep(uint32_t step, uint32_t depth);
  void timeLimit(const SfcStep& step, uint32_t depth);
  void actions();
  void transitions();
  void chain(const std::vector<uint32_t>& ways, size_t at, uint32_t depth);
  void condition(uint32_t way);
  void prepare(uint32_t way, uint32_t depth);
  void fire(uint32_t way, uint32_t depth);
  const SfcTransition& conditionOf(const SfcTransition& t) const;
  std::vector<std::vector<uint32_t>> waysBySteps() const;

  const Chart& chart_;
  const Charts& charts_;
  const Tree& tree_;
  Shapes& shapes_;
  Writer& out_;
};

void Scheduler::forWords(uint32_t depth, size_t count,
                         const std::function<void(const std::string& index, uint32_t depth)>& body) {
  const uint32_t words = chart_.words(count);
  if (words <= 1) return body("", depth);
  out_.line(depth, "FOR sfc_word := 0 TO ", std::to_string(words - 1), " DO");
  body("[sfc_word]", depth + 1);
  out_.line(depth, "END_FOR");
}

void Scheduler::scan(uint32_t depth, const char* set, size_t count, const std::function<bool(uint32_t)>& wanted,
                     const std::function<std::string_view(uint32_t)>& name, const Branch& branch) {
  uint32_t first = 0;
  while (first < count && !wanted(first)) ++first;
  if (first == count) return;
  out_.at(chart_.pou_.body_begin);
  forWords(depth, count, [&](const std::string& index, uint32_t inner) {
    out_.line(inner, "sfc_set := ", set, index, ";");
    out_.line(inner, "WHILE sfc_set <> LWORD#0 DO");
    out_.line(inner + 1, "CASE ", index.empty() ? "" : "sfc_word * 64 + ", "SFCTakeBit(sfc_set) OF");
    for (uint32_t i = first; i < count; ++i) {
      if (!wanted(i)) continue;
      out_.line(inner + 2, std::to_string(i), ":  // ", name(i));
      branch(i, inner + 3);
    }
    out_.at(chart_.pou_.body_begin);
    out_.line(inner + 1, "END_CASE");
    out_.line(inner, "END_WHILE");
  });
}

// The entry, active or exit actions of a step.
void Scheduler::run(uint32_t depth, const SfcStep& step, SfcQualifier when) {
  for (const SfcAssociation& a : tree_.list(step.actions)) {
    if (a.qualifier != when) continue;
    out_.at(a.action.loc);
    out_.line(depth, a.action, callsAction(a.action) ? "();" : " := TRUE;");
  }
}

// As before the first cycle.
void Scheduler::reset(uint32_t depth) {
  for (const SfcStep& step : chart_.steps_) {
    out_.at(step.name.loc);
    out_.line(depth, step.name, ".x := ", step.initial ? "TRUE;" : "FALSE;");
    out_.line(depth, step.name, "._x := ", step.initial ? "TRUE;" : "FALSE;");
    out_.line(depth, step.name, ".t := T#0s;");
  }
  for (const Ident& action : chart_.actions_) {
    out_.at(action.loc);
    out_.line(depth, "_", action, ".clear := TRUE;");
    out_.line(depth, "_", action, "();");
    if (!callsAction(action)) out_.line(depth, action, " := FALSE;");
  }
  out_.at(chart_.pou_.body_begin);
  forWords(depth, chart_.steps_.size(), [&](const std::string& index, uint32_t inner) {
    out_.line(inner, "sfc_steps", index, " := LWORD#0;");
    out_.line(inner, "sfc_left", index, " := LWORD#0;");
    out_.line(inner, "sfc_entered", index, " := LWORD#0;");
  });
  if (!chart_.actions_.empty())
    forWords(depth, chart_.actions_.size(),
             [&](const std::string& index, uint32_t inner) { out_.line(inner, "sfc_actions", index, " := LWORD#0;"); });
  for (uint32_t i = 0; i < chart_.steps_.size(); ++i)
    if (chart_.steps_[i].initial)
      out_.line(depth, stepWord("sfc_entered", i), " := ", stepWord("sfc_entered", i), " OR ", maskOf(i), ";");
  out_.line(depth, "sfc_fired := TRUE;");
  for (const char* name : {"SFCError", "SFCTrans"})
    if (const Ident* flag = chart_.flag(name)) out_.line(depth, *flag, " := FALSE;");
  for (const char* name : {"SFCErrorStep", "SFCErrorPOU", "SFCErrorAnalyzation"})
    if (const Ident* flag = chart_.flag(name)) out_.line(depth, *flag, " := '';");
}

void Scheduler::flags() {
  if (const Ident* flag = chart_.flag("SFCInit")) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    reset(1);
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (const Ident* flag = chart_.flag("SFCReset")) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    reset(1);
    out_.line(0, "END_IF");
  }
  out_.at(chart_.pou_.body_begin);
  out_.line(0, "sfc_now := TASK_TIME();");
  if (const Ident* flag = chart_.flag("SFCQuitError")) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    if (const Ident* error = chart_.flag("SFCError")) out_.line(1, *error, " := FALSE;");
    for (const char* name : {"SFCErrorStep", "SFCErrorPOU", "SFCErrorAnalyzation"})
      if (const Ident* text = chart_.flag(name)) out_.line(1, *text, " := '';");
    scan(
        1, "sfc_steps", chart_.steps_.size(), [](uint32_t) { return true; }, stepNames(),
        [&](uint32_t i, uint32_t depth) {
          out_.line(depth, chart_.name(i), "._t := sfc_now;");
          out_.line(depth, chart_.name(i), ".t := T#0s;");
        });
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (const Ident* flag = chart_.flag("SFCPause")) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (chart_.flag("SFCTipMode") != nullptr) {
    const Ident* tip = chart_.flag("SFCTip");
    out_.line(0, "sfc_tip := ", tip != nullptr ? chart_.text(tip->name) : "FALSE", " AND NOT sfc_tip_before;");
    out_.line(0, "sfc_tip_before := ", tip != nullptr ? chart_.text(tip->name) : "FALSE", ";");
  }
}

// What the transitions of the last cycle decided.
void Scheduler::evolve() {
  const size_t count = chart_.steps_.size();
  const auto all = [](uint32_t) { return true; };
  out_.at(chart_.pou_.body_begin);
  out_.line(0, "IF sfc_fired THEN");
  out_.line(1, "sfc_fired := FALSE;");
  scan(1, "sfc_left", count, all, stepNames(), [&](uint32_t i, uint32_t depth) {
    const SfcStep& step = chart_.steps_[i];
    out_.at(step.name.loc);
    out_.line(depth, step.name, ".x := FALSE;");
    run(depth, step, SfcQualifier::Exit);
  });
  scan(1, "sfc_entered", count, all, stepNames(), [&](uint32_t i, uint32_t depth) {
    const SfcStep& step = chart_.steps_[i];
    out_.at(step.name.loc);
    out_.line(depth, step.name, ".x := TRUE;");
    out_.line(depth, step.name, "._x := TRUE;");
    out_.line(depth, step.name, "._t := sfc_now;");
    out_.line(depth, step.name, ".t := T#0s;");
    run(depth, step, SfcQualifier::Entry);
  });
  forWords(1, count, [&](const std::string& index, uint32_t depth) {
    out_.line(depth, "sfc_steps", index, " := sfc_steps", index, " AND NOT sfc_left", index, " OR sfc_entered", index,
              ";");
    out_.line(depth, "sfc_left", index, " := LWORD#0;");
    out_.line(depth, "sfc_entered", index, " := LWORD#0;");
  });
  out_.line(0, "END_IF");
}

void Scheduler::timeLimit(const SfcStep& step, uint32_t depth) {
  const Ident* error = chart_.flag("SFCError");
  const Ident* enabled = chart_.flag("SFCEnableLimit");
  if (!step.max.value || error == nullptr) return;
  out_.at(step.max.begin);
  out_.line(depth, "IF ", step.name, ".t > ", step.max, " AND NOT ", *error, enabled != nullptr ? " AND " : "",
            enabled != nullptr ? chart_.text(enabled->name) : "", " THEN");
  out_.line(depth + 1, *error, " := TRUE;");
  if (const Ident* flag = chart_.flag("SFCErrorStep")) out_.line(depth + 1, *flag, " := '", step.name, "';");
  if (const Ident* flag = chart_.flag("SFCErrorPOU"))
    out_.line(depth + 1, *flag, " := '", chart_.text(chart_.pou_.name), "';");
  if (const Ident* flag = chart_.flag("SFCErrorAnalyzation")) {
    std::string blocking;
    for (const SfcTransition& t : chart_.transitions_) {
      const std::span<const Ident> from = tree_.list(t.from);
      if (std::none_of(from.begin(), from.end(),
                       [&](const Ident& s) { return charts_.names.same(s.name, step.name.name); }))
        continue;
      if (!blocking.empty()) blocking += " | ";
      for (const char c : t.condition.value && !t.name.name ? out_.textOf(t.condition) : chart_.text(t.name.name)) {
        if (c == '\'' || c == '$') blocking += '$';
        blocking += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
      }
    }
    if (blocking.size() > kTextLength) {  // what a STRING holds
      blocking.resize(kTextLength);
      while (blocking.ends_with('$')) blocking.pop_back();
    }
    out_.line(depth + 1, *flag, " := '", blocking, "';");
  }
  out_.line(depth, "END_IF");
}

void Scheduler::activeStep(uint32_t i, uint32_t depth) {
  const SfcStep& step = chart_.steps_[i];
  out_.at(step.name.loc);
  out_.line(depth, step.name, ".t := sfc_now - ", step.name, "._t;");
  timeLimit(step, depth);
  out_.at(step.name.loc);
  if (const Ident* flag = chart_.flag("SFCCurrentStep")) out_.line(depth, *flag, " := '", step.name, "';");
  run(depth, step, SfcQualifier::Active);
  for (const SfcAssociation& a : tree_.list(step.actions)) {
    if (!isControlled(a.qualifier)) continue;
    out_.at(a.loc);
    out_.line(depth, "_", a.action, ".", wordOf(a.qualifier), " := TRUE;");
    if (a.time.value) {
      out_.line(depth, "_", a.action, ".T := ", a.time, ";");
      out_.at(a.loc);
    }
    const uint32_t action = chart_.actionOf(a.action.name);
    const std::string set = word("sfc_actions", chart_.actions_.size(), action);
    out_.line(depth, set, " := ", set, " OR ", maskOf(action), ";");
  }
}

void Scheduler::actions() {
  const size_t count = chart_.actions_.size();
  scan(
      0, "sfc_actions", count, [](uint32_t) { return true; }, actionNames(),
      [&](uint32_t i, uint32_t depth) {
        const Ident& action = chart_.actions_[i];
        const std::string set = word("sfc_actions", count, i);
        out_.at(action.loc);
        out_.line(depth, "_", action, "();");
        if (callsAction(action)) {
          out_.line(depth, "IF _", action, ".x AND NOT _", action, "._x THEN");
          out_.line(depth + 1, action, "();");
          out_.line(depth, "END_IF");
        } else {
          out_.line(depth, action, " := _", action, "._x;");
        }
        out_.line(depth, "IF NOT _", action, ".busy THEN");
        out_.line(depth + 1, set, " := ", set, " AND NOT ", maskOf(i), ";");
        out_.line(depth, "END_IF");
      });
  scan(
      0, "sfc_actions", count, [&](uint32_t i) { return callsAction(chart_.actions_[i]); }, actionNames(),
      [&](uint32_t i, uint32_t depth) {
        const Ident& action = chart_.actions_[i];
        out_.at(action.loc);
        out_.line(depth, "IF _", action, "._x THEN");
        out_.line(depth + 1, action, "();");
        out_.line(depth, "END_IF");
      });
}

// `TRANSITION t FROM a TO b;` has the condition of `TRANSITION t := …`, or is named like a variable.
const SfcTransition& Scheduler::conditionOf(const SfcTransition& t) const {
  if (t.body || t.condition.value) return t;
  for (const SfcTransition& other : chart_.transitions_)
    if (other.body && charts_.names.same(other.name.name, t.name.name)) return other;
  return t;
}

void Scheduler::prepare(uint32_t way, uint32_t depth) {
  const SfcTransition& t = conditionOf(chart_.transitions_[way]);
  out_.at(t.loc);
  if (t.body)
    out_.line(depth, chart_.text(tree_.as<PouDecl>(t.body).name), "();");
  else if (chart_.keepsCondition(t))
    out_.line(depth, t.target, " := ", t.condition, ";");
}

void Scheduler::condition(uint32_t way) {
  const SfcTransition& own = chart_.transitions_[way];
  const SfcTransition& t = conditionOf(own);
  const std::span<const Ident> from = tree_.list(own.from);
  const bool tips = chart_.flag("SFCTipMode") != nullptr;
  out_.at(own.loc);
  std::string before;
  for (size_t i = 1; i < from.size(); ++i) {
    before += std::string(chart_.text(from[i].name)) + ".x AND " + std::string(chart_.text(from[i].name)) + "._x AND ";
  }
  const bool quoted = t.condition.value && !chart_.keepsCondition(t);
  if (quoted && tree_.kind(t.condition.value) == ExprKind::Literal && before.empty() && !tips)
    before = std::string(chart_.text(from[0].name)) + ".x AND ";  // no IF on a constant
  out_.put(before);
  for (size_t i = 1; i < from.size(); ++i) {
    const SfcStep& step = chart_.steps_[chart_.index_.of(from[i].name)];
    if (!step.min.value) continue;
    out_.put(step.name);
    out_.put(".t >= ");
    out_.put(step.min);
    out_.put(" AND ");
  }
  if (tips) {
    out_.put("SEL(");
    out_.put(*chart_.flag("SFCTipMode"));
    out_.put(", ");
  }
  if (!quoted) {
    out_.put(t.target.name ? t.target : t.name);
  } else {
    const bool parens = from.size() > 1 && !tips;
    if (parens) out_.put("(");
    out_.put(t.condition);
    if (parens) out_.put(")");
  }
  if (tips) out_.put(", sfc_tip)");
}

void Scheduler::fire(uint32_t way, uint32_t depth) {
  const SfcTransition& t = chart_.transitions_[way];
  out_.at(t.loc);
  for (const Ident& step : tree_.list(t.from)) {
    const uint32_t i = chart_.index_.of(step.name);
    out_.line(depth, step, "._x := FALSE;");
    out_.line(depth, stepWord("sfc_left", i), " := ", stepWord("sfc_left", i), " OR ", maskOf(i), ";");
  }
  for (const Ident& step : tree_.list(t.to)) {
    const uint32_t i = chart_.index_.of(step.name);
    out_.line(depth, step, "._x := TRUE;");
    out_.line(depth, stepWord("sfc_entered", i), " := ", stepWord("sfc_entered", i), " OR ", maskOf(i), ";");
  }
  out_.line(depth, "sfc_fired := TRUE;");
  if (chart_.flag("SFCTipMode") != nullptr) out_.line(depth, "sfc_tip := FALSE;");
}

// The first way whose condition is TRUE.
void Scheduler::chain(const std::vector<uint32_t>& ways, size_t at, uint32_t depth) {
  const auto prepared = [&](size_t k) {
    const SfcTransition& t = conditionOf(chart_.transitions_[ways[k]]);
    return t.body || chart_.keepsCondition(t);
  };
  if (prepared(at)) prepare(ways[at], depth);
  out_.at(chart_.transitions_[ways[at]].loc);
  for (size_t k = at;; ++k) {
    out_.put(std::string(2 * depth, ' '));
    out_.put(k == at ? "IF " : "ELSIF ");
    condition(ways[k]);
    out_.at(chart_.transitions_[ways[k]].loc);
    out_.put(" THEN\n");
    fire(ways[k], depth + 1);
    if (k + 1 == ways.size()) break;
    if (prepared(k + 1)) {
      out_.line(depth, "ELSE");
      chain(ways, k + 1, depth + 1);
      break;
    }
  }
  out_.line(depth, "END_IF");
}

// The transitions that are judged with each step: a transition from several steps with the first of them.
std::vector<std::vector<uint32_t>> Scheduler::waysBySteps() const {
  std::vector<std::vector<uint32_t>> ways(chart_.steps_.size());
  for (uint32_t i = 0; i < chart_.transitions_.size(); ++i)
    if (!chart_.transitions_[i].from.empty())
      ways[chart_.index_.of(tree_.list(chart_.transitions_[i].from)[0].name)].push_back(i);
  // Smaller numbers first; those without a number behind them, in the order of the text.
  const auto rank = [&](uint32_t i) {
    return chart_.transitions_[i].has_priority ? chart_.transitions_[i].priority : UINT32_MAX;
  };
  for (std::vector<uint32_t>& of : ways)
    std::stable_sort(of.begin(), of.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
  return ways;
}

void Scheduler::transitions() {
  const std::vector<std::vector<uint32_t>> ways = waysBySteps();
  std::vector<bool> joined(chart_.steps_.size());  // may be left by a transition that is judged with another step
  for (const SfcTransition& t : chart_.transitions_) {
    const std::span<const Ident> from = tree_.list(t.from);
    for (size_t i = 1; i < from.size(); ++i) joined[chart_.index_.of(from[i].name)] = true;
  }
  scan(
      0, "sfc_steps", chart_.steps_.size(), [&](uint32_t i) { return !ways[i].empty(); }, stepNames(),
      [&](uint32_t i, uint32_t depth) {
        const SfcStep& step = chart_.steps_[i];
        const bool guarded = step.min.value || joined[i];
        out_.at(step.name.loc);
        if (guarded) {
          out_.put(std::string(2 * depth, ' ') + "IF ");
          if (joined[i]) {
            out_.put(step.name);
            out_.put(step.min.value ? "._x AND " : "._x");
          }
          if (step.min.value) {
            out_.put(step.name);
            out_.put(".t >= ");
            out_.put(step.min);
          }
          out_.put(" THEN\n");
        }
        chain(ways[i], 0, depth + (guarded ? 1 : 0));
        if (guarded) out_.line(depth, "END_IF");
      });
  if (const Ident* flag = chart_.flag("SFCTrans")) {
    out_.at(flag->loc);
    out_.line(0, *flag, " := sfc_fired;");
  }
}

void Scheduler::run() {
  flags();
  evolve();
  scan(
      0, "sfc_steps", chart_.steps_.size(), [](uint32_t) { return true; }, stepNames(),
      [&](uint32_t i, uint32_t depth) { activeStep(i, depth); });
  actions();
  transitions();
}

}  // namespace

void declareSfc(const Charts& charts, PouDecl& pou, bool final_scan) {
  const Chart chart(charts, pou);
  Writer out(charts, pou.body_begin);
  writeSections(chart, out, final_scan);
  pou.chart_sections = out.finish();
  std::vector<DeclId> sections(charts.tree.list(pou.sections).begin(), charts.tree.list(pou.sections).end());
  const Slice<DeclId> made =
      parseSections(charts.tree, charts.names, charts.sources, pou.chart_sections, charts.standard, charts.diagnostics);
  for (const DeclId section : charts.tree.list(made)) sections.push_back(section);
  pou.sections = charts.tree.addList<DeclId>(sections);
}

// False: sema has said that a name is declared twice.
static bool namesDiffer(const Charts& charts, const PouDecl& pou) {
  std::vector<uint32_t> keys;
  for (const DeclId section : charts.tree.list(pou.sections))
    for (const DeclId var : charts.tree.list(charts.tree.as<SectionDecl>(section).vars))
      for (const Ident& name : charts.tree.list(charts.tree.as<VarDecl>(var).names))
        keys.push_back(charts.names.key(name.name).index);
  for (const DeclId member : charts.tree.list(pou.members))
    if (charts.tree.kind(member) == DeclKind::Pou)
      keys.push_back(charts.names.key(charts.tree.as<PouDecl>(member).name).index);
  std::sort(keys.begin(), keys.end());
  return std::adjacent_find(keys.begin(), keys.end()) == keys.end();
}

bool scheduleSfc(const Charts& charts, Shapes& shapes, PouDecl& pou) {
  if (!checkSfc(charts, shapes, pou) || !namesDiffer(charts, pou)) return false;
  const Chart chart(charts, pou);
  Writer out(charts, pou.body_begin);
  Scheduler(chart, shapes, out).run();
  out.at(pou.body_begin);
  pou.chart_body = out.finish();
  pou.body =
      parseStatements(charts.tree, charts.names, charts.sources, pou.chart_body, charts.standard, charts.diagnostics);
  return true;
}

}  // namespace rung::text
