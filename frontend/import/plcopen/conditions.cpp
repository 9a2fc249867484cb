// SPDX-License-Identifier: Apache-2.0
// Transitions of a chart and their conditions; see chart.h. A condition that is an expression is written in the
// transition itself; any other, and a named one, is a separate TRANSITION without FROM, to which transitions refer by
// name.
#include <algorithm>
#include <utility>

#include "frontend/import/diagnostics.h"
#include "frontend/import/plcopen/chart.h"
#include "frontend/import/plcopen/networks.h"
#include "frontend/source/names.h"
#include "frontend/syntax/diagram.h"

namespace rung::importer::plcopen {
namespace {

constexpr uint32_t kMaxCondition = 4096;  // contacts and variables of one condition
constexpr uint32_t kMaxContacts = 1000;   // in a row

enum class Form : uint8_t { Empty, Expression, Statements };

// `a AND b`, `a AND b;` and `:= a AND b;` are expressions, in [begin, end); `t := a; b();` are statements.
Form formOf(std::string_view text, size_t& begin, size_t& end) {
  Scanner scanner(text);
  char before = '\0';
  uint32_t depth = 0;
  bool first = true, closed = false;
  begin = end = 0;
  for (Unit unit = scanner.nextCode(); unit.kind != UnitKind::End; unit = scanner.nextCode()) {
    if (closed) return Form::Statements;  // code after the `;`
    const char c = unit.kind == UnitKind::Other ? text[unit.begin] : 'x', last = std::exchange(before, c);
    if (c == '=' && last == ':' && depth == 0) {
      if (!first) return Form::Statements;
      begin = end = unit.end;
      first = false;
      continue;
    }
    if (c == ':' && end == 0) continue;  // may be part of `:=`
    if (c == '(' || c == '[') ++depth;
    if ((c == ')' || c == ']') && depth > 0) --depth;
    closed = c == ';';
    if (closed) continue;
    if (first) begin = unit.begin;
    first = false;
    end = unit.end;
  }
  return end == begin ? Form::Empty : Form::Expression;
}

// Bytes [begin, end) of the decoded content of an element.
void writePart(Import& import, const xml::Element& element, size_t begin, size_t end) {
  size_t at = 0;
  for (uint32_t i = element.first_run; i < element.end_run && at < end; ++i) {
    const xml::Run& run = import.document.runs[i];
    std::string character;
    if (run.character != 0) appendUtf8(character, run.character);
    const size_t length = run.character != 0 ? character.size() : run.length;
    const size_t from = std::max(at, begin), to = std::min(at + length, end);
    if (from < to) {
      const auto loc = [&](size_t offset) { return Loc{run.loc.offset + static_cast<uint32_t>(offset - at)}; };
      if (run.character != 0)
        import.out.replace(run.loc, {run.loc.offset + run.length}, character);
      else
        import.out.add(loc(from), loc(to));
    }
    at += length;
  }
}

// The only language in a <body> or <inline>; null: missing.
const xml::Element* languageOf(const Import& import, const xml::Element& body) {
  for (const xml::Element& e : import.document.children(body))
    if (e.name != "addData" && e.name != "documentation") return &e;
  return nullptr;
}

const xml::Element* bodyOf(const Import& import, const xml::Element& element) {
  return element.name == "transition" ? import.document.child(element, "body") : &element;
}

}  // namespace

// The transition of the POU with this name.
const xml::Element* Chart::namedTransition(std::string_view name) {
  if (named_.empty()) {
    const xml::Element* list = document_.child(pou_, "transitions");
    for (const xml::Element& e : document_.children(list))
      if (e.name == "transition") named_.emplace(upper(document_.value(e, "name")), &e);
    named_.emplace("", nullptr);
  }
  const auto found = named_.find(upper(name));
  return found == named_.end() ? nullptr : found->second;
}

void Chart::define(const std::string& name, const xml::Element& element) {
  Chart* whole = this;  // a transition that a macro step names too is defined only once
  while (whole->outer_ != nullptr) whole = whole->outer_;
  if (whole->defined_.insert(&element).second) definitions_.push_back({name, &element});
}

// Reads the content of <inline>. False: it is empty, which was reported.
bool Chart::readBody(const xml::Element& inline_body, const std::string& name, Condition& out) {
  const xml::Element* language = languageOf(import_, inline_body);
  if (language != nullptr && language->name == "ST") {
    const std::string text = document_.text(*language, import_.sources);
    const Form form = formOf(text, out.begin, out.end);
    if (form == Form::Expression) out.text = language;
    if (form == Form::Statements) define(out.definition = name, inline_body);
    if (form != Form::Empty) return true;
  } else if (language != nullptr) {
    define(out.definition = name, inline_body);
    return true;
  }
  report(diag::ChartNoCondition, inline_body.loc, {});
  return false;
}

// Forbids a transition without a condition. TC6 2.01, transition.
//   fails   <condition><inline><ST/></inline></condition>          E1066
bool Chart::readCondition(uint32_t node, Condition& out) {
  const xml::Element& transition = *nodes_[node].element;
  const std::string own = "sfc_condition_" + own_prefix_ + std::to_string(node);
  const xml::Element* condition = document_.child(transition, "condition");
  if (condition == nullptr) {
    report(diag::ChartNoCondition, transition.loc, {});
    return false;
  }
  out.negated = isTrue(import_, *condition, "negated");
  if (const xml::Element* reference = document_.child(*condition, "reference")) {
    if (!checkName(import_, *reference)) return false;
    const std::string name = document_.value(*reference, "name");
    if (const xml::Element* named = namedTransition(name))
      define(out.definition = name, *named);
    else
      out.variable = document_.attribute(*reference, "name");
    return true;
  }
  if (const xml::Element* inline_body = document_.child(*condition, "inline")) return readBody(*inline_body, own, out);
  const bool was_ok = ok_;
  for (const ChartWire& wire : wiresOf(*condition)) out.wires.push_back(wire.from);
  if (was_ok && !ok_) return false;
  if (out.wires.empty()) {
    report(diag::ChartNoCondition, condition->loc, {});
    return false;
  }
  uint32_t budget = kMaxCondition;
  const bool simple =
      std::all_of(out.wires.begin(), out.wires.end(), [&](uint32_t from) { return isExpression(from, 0, budget); });
  if (simple) return true;
  out.wires.clear();
  define(out.definition = own, *condition);
  return true;
}

std::vector<uint32_t> Chart::sourcesOf(uint32_t node) const {
  std::vector<uint32_t> out;
  if (nodes_[node].kind == NodeKind::Input) return out;  // its input wires, if any, have no meaning
  for (uint32_t w = nodes_[node].first_wire; w < nodes_[node].end_wire; ++w) out.push_back(wires_[w].from);
  return out;
}

// Contacts, variables and rails are expressions; edges and blocks need memory or statements.
bool Chart::isExpression(uint32_t node, uint32_t depth, uint32_t& budget) const {
  const ChartNode& n = nodes_[node];
  if (budget == 0 || depth == kMaxContacts) return false;
  --budget;
  if (n.kind == NodeKind::Input || n.kind == NodeKind::Rail) return true;
  const std::string_view edge = raw(*n.element, "edge");
  if (n.kind == NodeKind::Contact && !edge.empty() && edge != "none") return false;
  if (n.kind != NodeKind::Contact && n.kind != NodeKind::Continuation && n.kind != NodeKind::Connector) return false;
  const std::vector<uint32_t> from = sourcesOf(node);
  return std::all_of(from.begin(), from.end(),
                     [&](uint32_t before) { return isExpression(before, depth + 1, budget); });
}

// (a OR b)
void Chart::writeDisjunction(const std::vector<uint32_t>& from) {
  if (from.size() > 1) import_.out.word("(");
  for (size_t i = 0; i < from.size(); ++i) {
    if (i > 0) import_.out.word(" OR ");
    writeOperand(from[i]);
  }
  if (from.size() > 1) import_.out.word(")");
}

void Chart::writeOperand(uint32_t node) {
  const xml::Element& e = *nodes_[node].element;
  const std::vector<uint32_t> from = sourcesOf(node);
  if (nodes_[node].kind == NodeKind::Rail) return import_.out.put(e.loc, "TRUE");
  if (nodes_[node].kind == NodeKind::Continuation || nodes_[node].kind == NodeKind::Connector)
    return writeDisjunction(from);
  const bool after_rail =
      std::all_of(from.begin(), from.end(), [&](uint32_t before) { return nodes_[before].kind == NodeKind::Rail; });
  if (!after_rail) {
    import_.out.word("(");
    writeDisjunction(from);
    import_.out.word(" AND ");
  }
  import_.out.put(e.loc, isTrue(import_, e, "negated") ? "NOT (" : "(");
  const xml::Element* text = document_.child(e, nodes_[node].kind == NodeKind::Input ? "expression" : "variable");
  size_t begin = 0, end = 0;
  const Form form = text == nullptr ? Form::Empty : formOf(document_.text(*text, import_.sources), begin, end);
  if (form == Form::Empty)
    import_.out.word("FALSE");
  else if (form == Form::Expression)
    writePart(import_, *text, begin, end);  // without its `;`
  else
    writeText(import_, *text);
  import_.out.word(after_rail ? ")" : "))");
}

void Chart::writeExpression(const Condition& condition) {
  if (condition.text != nullptr)
    writePart(import_, *condition.text, condition.begin, condition.end);
  else if (condition.variable != nullptr)
    import_.out.add(document_, *condition.variable);
  else
    writeDisjunction(condition.wires);
}

std::vector<xml::Excerpt> Chart::namesOf(const std::vector<uint32_t>& steps) const {
  std::vector<xml::Excerpt> names;
  names.reserve(steps.size());
  for (const uint32_t step : steps) names.push_back(stepName(step));
  return names;
}

// A TRANSITION for each set of steps from which it can fire.
void Chart::writeTransition(uint32_t node) {
  const xml::Element& element = *nodes_[node].element;
  Condition condition;
  if (ways_[node].sets.empty() || !readCondition(node, condition)) return;
  const std::string inverse = condition.definition + "_not";
  ChartTransition transition;
  transition.loc = element.loc;
  const xml::Element* exported = dataOf(import_, element, "extension");  // by Rung
  if (!condition.definition.empty())
    transition.name = xml::Excerpt(condition.negated ? inverse : condition.definition);
  else if (exported != nullptr && checkName(import_, *exported))
    transition.name = {document_, *document_.attribute(*exported, "name")};
  transition.area = areaOf(document_, element);
  if (hasName(import_, element, "priority") && raw(element, "priority") != "0")
    transition.priority = {document_, *document_.attribute(element, "priority")};
  transition.to = namesOf(targets_[node]);
  for (const Steps& from : ways_[node].sets) {
    transition.from = namesOf(from);
    writer_.beginTransition(transition);
    if (condition.definition.empty()) {
      import_.out.word(condition.negated ? " := NOT (" : " := ");
      writeExpression(condition);
      import_.out.word(condition.negated ? "\n);" : "\n;");
    } else if (condition.negated) {
      import_.out.word(" :\n" + condition.definition + "_condition();\n" + inverse + " := NOT " + condition.definition +
                       ";\n");
    }
    writer_.endTransition(element.end);
  }
}

// TRANSITION name := x; END_TRANSITION, or with a body that assigns to the name.
void Chart::writeDefinition(const Definition& definition) {
  const xml::Element& e = *definition.element;
  import_.out.put(e.loc, "TRANSITION " + definition.name);
  const std::string of = e.name == "transition" ? name_ + "." + definition.name : name_;
  const xml::Element* body = bodyOf(import_, e);
  const xml::Element* language = body == nullptr ? nullptr : languageOf(import_, *body);
  size_t begin = 0, end = 0;
  if (e.name == "condition") {
    import_.out.word(" :\n");
    const xml::Element* wires = document_.child(e, "connectionPointIn");
    const DrawnBody diagram{chart_, NetworkLanguage::Ladder, wires == nullptr ? &e : wires, definition.name};
    writeNetworks(import_, diagram);
  } else if (language == nullptr) {
    report(diag::ChartNoCondition, e.loc, {});
    import_.out.word(" := FALSE;\n");
  } else if (language->name != "ST") {
    import_.out.word(" :\n");
    if (!writeBody(import_, *body, pou_, of)) import_.out.word(definition.name + " := FALSE;\n");
  } else {
    const std::string text = document_.text(*language, import_.sources);
    switch (formOf(text, begin, end)) {
      case Form::Empty:
        report(diag::ChartNoCondition, language->loc, {});
        import_.out.word(" := FALSE;\n");
        break;
      case Form::Expression:
        import_.out.word(" := ");
        writePart(import_, *language, begin, end);
        import_.out.word("\n;\n");
        break;
      case Form::Statements:
        import_.out.word(" :\n");
        writeText(import_, *language);
        import_.out.word("\n");
        break;
    }
  }
  import_.out.put(e.end, "END_TRANSITION\n");
}

}  // namespace rung::importer::plcopen
