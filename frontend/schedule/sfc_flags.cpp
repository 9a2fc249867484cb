// SPDX-License-Identifier: Apache-2.0
// Flags of a chart and the time limits of its steps; see sfc_scheduler.h. TM/TP manual 5.5.2.5.
#include <algorithm>

#include "frontend/schedule/sfc_scheduler.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

namespace {
constexpr size_t kMaxStringLength = 80;
}  // namespace

// Resets the chart to its state before the first cycle.
void SfcScheduler::reset(uint32_t depth) {
  for (const SfcStep& step : chart_.steps_) {
    out_.at(step.name.loc);
    out_.line(depth, step.name, ".x := ", step.initial ? "TRUE;" : "FALSE;");
    out_.line(depth, step.name, "._x := ", step.initial ? "TRUE;" : "FALSE;");
    out_.line(depth, step.name, ".t := T#0s;");
  }
  for (uint32_t i = 0; i < chart_.actions_.size(); ++i) {
    const Ident& action = chart_.actions_[i];
    const std::string& control = chart_.controlOf(i);
    out_.at(action.loc);
    out_.line(depth, control, ".clear := TRUE;");
    out_.line(depth, control, "();");
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
  for (const SfcFlag name : {SfcFlag::Error, SfcFlag::Trans})
    if (const Ident* flag = chart_.flag(name)) out_.line(depth, *flag, " := FALSE;");
  for (const SfcFlag name : {SfcFlag::ErrorStep, SfcFlag::ErrorPou, SfcFlag::ErrorAnalyzation})
    if (const Ident* flag = chart_.flag(name)) out_.line(depth, *flag, " := '';");
  clearTable(depth);
}

void SfcScheduler::flags() {
  if (const Ident* flag = chart_.flag(SfcFlag::Init)) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    reset(1);
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (const Ident* flag = chart_.flag(SfcFlag::Reset)) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    reset(1);
    out_.line(0, "END_IF");
  }
  out_.at(chart_.pou_.body_begin);
  out_.line(0, "sfc_now := TASK_TIME();");
  // While the chart is paused, its time stops too.
  const Ident* quit = chart_.flag(SfcFlag::QuitError);
  const Ident* pause = chart_.flag(SfcFlag::Pause);
  if (quit != nullptr || pause != nullptr) {
    const std::string_view first = chart_.string((quit != nullptr ? quit : pause)->name);
    const std::string second =
        quit == nullptr || pause == nullptr ? "" : " OR " + std::string(chart_.string(pause->name));
    out_.line(0, "IF ", first, second, " THEN");
    out_.line(1, "sfc_paused := sfc_paused + (sfc_now - sfc_last);");
    out_.line(0, "END_IF");
    out_.line(0, "sfc_last := sfc_now;");
    out_.line(0, "sfc_now := sfc_now - sfc_paused;");
  }
  if (const Ident* flag = quit) {
    out_.at(flag->loc);
    out_.line(0, "IF ", *flag, " THEN");
    if (const Ident* error = chart_.flag(SfcFlag::Error)) out_.line(1, *error, " := FALSE;");
    for (const SfcFlag name : {SfcFlag::ErrorStep, SfcFlag::ErrorPou, SfcFlag::ErrorAnalyzation})
      if (const Ident* text = chart_.flag(name)) out_.line(1, *text, " := '';");
    clearTable(1);
    scan(
        1, "sfc_steps", chart_.steps_.size(), [](uint32_t) { return true; }, stepNames(),
        [&](uint32_t i, uint32_t depth) {
          out_.line(depth, chart_.name(i), "._t := sfc_now;");
          out_.line(depth, chart_.name(i), ".t := T#0s;");
        });
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (pause != nullptr) {
    out_.at(pause->loc);
    out_.line(0, "IF ", *pause, " THEN");
    out_.line(1, "RETURN;");
    out_.line(0, "END_IF");
  }
  if (chart_.flag(SfcFlag::TipMode) != nullptr) {
    const Ident* tip = chart_.flag(SfcFlag::Tip);
    out_.line(0, "sfc_tip := ", tip != nullptr ? chart_.string(tip->name) : "FALSE", " AND NOT sfc_tip_before;");
    out_.line(0, "sfc_tip_before := ", tip != nullptr ? chart_.string(tip->name) : "FALSE", ";");
  }
}

// The content of a string literal, cut to the size of a STRING.
std::string SfcScheduler::quoted(std::string_view text) {
  std::string out;
  size_t length = 0;
  for (const char c : text) {
    if (++length > kMaxStringLength) break;
    if (c == '\'' || c == '$') out += '$';
    out += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return out;
}

std::vector<const SfcTransition*> SfcScheduler::leaving(const SfcStep& step) const {
  std::vector<const SfcTransition*> out;
  for (const SfcTransition& t : chart_.transitions_)
    for (const Ident& from : tree_.list(t.from))
      if (charts_.names.same(from.name, step.name.name)) out.push_back(&t);
  return out;
}

void SfcScheduler::clearTable(uint32_t depth) {
  const Ident* table = chart_.flag(SfcFlag::ErrorAnalyzationTable);
  if (table == nullptr) return;
  out_.line(depth, "FOR sfc_row := LOWER_BOUND(", *table, ", 1) TO UPPER_BOUND(", *table, ", 1) DO");
  out_.line(depth + 1, *table, "[sfc_row].name := '';");
  out_.line(depth + 1, *table, "[sfc_row].value := FALSE;");
  out_.line(depth, "END_FOR");
}

template <class Condition>
void SfcScheduler::analyseLeaf(const Condition& condition, std::string_view text, bool wanted, uint32_t depth) {
  const Ident& table = *chart_.flag(SfcFlag::ErrorAnalyzationTable);
  out_.line(depth, "IF sfc_row <= UPPER_BOUND(", table, ", 1) AND ", wanted ? "NOT " : "", "(", condition);
  out_.line(depth, ") THEN");  // on a separate line: the condition may end with a comment
  out_.line(depth + 1, table, "[sfc_row].name := '", quoted(text), "';");
  out_.line(depth + 1, table, "[sfc_row].value := ", wanted ? "FALSE;" : "TRUE;");
  out_.line(depth + 1, "sfc_row := sfc_row + 1;");
  out_.line(depth, "END_IF");
}

// A row for each operand that keeps a condition from being `wanted`: of AND those that are FALSE, of OR all if none is
// TRUE, after NOT the other way round.
void SfcScheduler::analyse(const SfcExpr& e, bool wanted, uint32_t depth) {
  const ExprKind kind = tree_.kind(e.value);
  if (kind == ExprKind::Unary && tree_.as<UnaryExpr>(e.value).op() == UnaryOp::Not) {
    const ExprId operand = tree_.as<UnaryExpr>(e.value).operand;
    return analyse({operand, tree_.begin(operand), e.end}, !wanted, depth);
  }
  const BinaryOp op = kind == ExprKind::Binary ? tree_.as<BinaryExpr>(e.value).op() : BinaryOp::Xor;
  const bool all = op == BinaryOp::And || op == BinaryOp::AndThen;
  if (!all && op != BinaryOp::Or && op != BinaryOp::OrElse)
    return analyseLeaf(part(e), out_.textOf(part(e)), wanted, depth);
  const BinaryExpr& node = tree_.as<BinaryExpr>(e.value);
  const bool each = all == wanted;  // one operand is enough to block
  if (!each) {
    out_.line(depth, "IF ", wanted ? "NOT " : "", "(", part(e));
    out_.line(depth, ") THEN");
  }
  analyse({node.left, tree_.begin(node.left), node.h.loc}, wanted, depth + (each ? 0 : 1));
  analyse({node.right, tree_.begin(node.right), e.end}, wanted, depth + (each ? 0 : 1));
  if (!each) out_.line(depth, "END_IF");
}

// The source of one operand of a condition, without trailing blanks and the closing parentheses of enclosing
// expressions.
SfcExpr SfcScheduler::part(const SfcExpr& e) const {
  std::string_view text = out_.textOf(e);
  size_t depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'' || text[i] == '"') {
      const char mark = text[i++];
      while (i < text.size() && text[i] != mark) i += text[i] == '$' ? 2 : 1;
    } else if (text[i] == '(' || text[i] == '[') {
      ++depth;
    } else if ((text[i] == ')' || text[i] == ']') && depth-- == 0) {
      text = text.substr(0, i);
    }
  }
  const size_t last = text.find_last_not_of(" \t\r\n");
  return {e.value, e.begin, {e.begin.offset + static_cast<uint32_t>(last + 1)}};
}

void SfcScheduler::timeLimit(const SfcStep& step, uint32_t depth) {
  const Ident* error = chart_.flag(SfcFlag::Error);
  const Ident* enabled = chart_.flag(SfcFlag::EnableLimit);
  if (!step.max.value || error == nullptr) return;
  out_.at(step.max.begin);
  out_.line(depth, "IF ", step.name, ".t > ", step.max, " AND NOT ", *error, enabled != nullptr ? " AND " : "",
            enabled != nullptr ? chart_.string(enabled->name) : "", " THEN");
  out_.line(depth + 1, *error, " := TRUE;");
  if (const Ident* flag = chart_.flag(SfcFlag::ErrorStep)) out_.line(depth + 1, *flag, " := '", step.name, "';");
  if (const Ident* flag = chart_.flag(SfcFlag::ErrorPou))
    out_.line(depth + 1, *flag, " := '",
              chart_.context_.around.empty() ? "" : chart_.string(chart_.context_.around.back()->name),
              chart_.context_.around.empty() ? "" : ".", chart_.string(chart_.pou_.name), "';");
  if (const Ident* flag = chart_.flag(SfcFlag::ErrorAnalyzation)) {
    std::string blocking;
    for (const SfcTransition* t : leaving(step)) {
      if (!blocking.empty()) blocking += " | ";
      blocking += t->condition.value && !t->name.name ? out_.textOf(t->condition) : chart_.string(t->name.name);
    }
    out_.line(depth + 1, *flag, " := '", quoted(blocking), "';");
  }
  if (const Ident* flag = chart_.flag(SfcFlag::ErrorAnalyzationTable)) {
    clearTable(depth + 1);
    out_.line(depth + 1, "sfc_row := LOWER_BOUND(", *flag, ", 1);");
    for (const SfcTransition* t : leaving(step)) {
      out_.at(t->loc);
      const SfcTransition& own = conditionOf(*t);
      if (own.condition.value && !chart_.keepsCondition(own))
        analyse(own.condition, true, depth + 1);
      else
        analyseLeaf(t->name.name ? t->name : own.target, chart_.string(t->name.name ? t->name.name : own.target.name),
                    true, depth + 1);
    }
    out_.at(step.max.begin);
  }
  out_.line(depth, "END_IF");
}

}  // namespace rung::text
