// SPDX-License-Identifier: Apache-2.0
// Flags of a chart and the time limits of its steps; see sfc_scheduler.h. TM/TP manual 5.5.2.5.
#include "frontend/schedule/sfc_scheduler.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

namespace {

constexpr size_t kMaxStringLength = 80;
constexpr SfcFlag kErrorTexts[] = {SfcFlag::ErrorStep, SfcFlag::ErrorPou, SfcFlag::ErrorAnalyzation};

// Source on one line, cut to the size of a STRING.
std::string onOneLine(std::string_view source) {
  std::string out(source.substr(0, kMaxStringLength));
  for (char& c : out)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return out;
}

}  // namespace

// ---- reset

// The chart before its first cycle.
void SfcScheduler::reset() {
  for (const SfcStep& of : chart_.steps_) {
    make_.at(of.name.loc);
    make_.set(step(of, "x"), of.initial);
    make_.set(step(of, "_x"), of.initial);
    make_.assign(step(of, "t"), make_.noTime());
  }
  for (uint32_t i = 0; i < chart_.actions_.size(); ++i) {
    const Ident& action = chart_.actions_[i];
    make_.at(action.loc);
    make_.set(control(i, "clear"), true);
    make_.callStatement(make_.call(control(i)));
    if (!callsAction(action)) make_.set(make_.path(action.name), false);
  }
  make_.at(chart_.pou_.body_begin);
  resetWords();
  make_.set(make_.name("sfc_fired"), true);
  for (const SfcFlag name : {SfcFlag::Error, SfcFlag::Trans})
    if (chart_.flag(name) != nullptr) make_.set(flag(name), false);
  clearTexts();
}

void SfcScheduler::resetWords() {
  forWords(SfcSet::Steps, [&] {
    clearWords(SfcSet::Steps);
    clearWords(SfcSet::Left);
    clearWords(SfcSet::Entered);
  });
  if (!chart_.actions_.empty()) forWords(SfcSet::Actions, [&] { clearWords(SfcSet::Actions); });
  for (uint32_t i = 0; i < chart_.steps_.size(); ++i)
    if (chart_.steps_[i].initial) add(SfcSet::Entered, i);
}

// What SFCErrorStep, SFCErrorPOU, SFCErrorAnalyzation and SFCErrorAnalyzationTable say.
void SfcScheduler::clearTexts() {
  for (const SfcFlag name : kErrorTexts)
    if (chart_.flag(name) != nullptr) make_.assign(flag(name), make_.text({}));
  clearTable();
}

ExprId SfcScheduler::tableBound(std::string_view function) {
  return make_.call(function, {flag(SfcFlag::ErrorAnalyzationTable), make_.number(1)});
}

ExprId SfcScheduler::rowMember(std::string_view member) {
  return make_.member(make_.element(flag(SfcFlag::ErrorAnalyzationTable), make_.name("sfc_row")), member);
}

void SfcScheduler::clearTable() {
  if (chart_.flag(SfcFlag::ErrorAnalyzationTable) == nullptr) return;
  make_.count(make_.name("sfc_row"), tableBound("LOWER_BOUND"), tableBound("UPPER_BOUND"), [&] {
    make_.assign(rowMember("name"), make_.text({}));
    make_.set(rowMember("value"), false);
  });
}

// ---- flags

void SfcScheduler::flags() {
  if (const Ident* init = chart_.flag(SfcFlag::Init)) {
    make_.at(init->loc);
    make_.when(make_.name(init->name), [&] {
      reset();
      make_.leave();
    });
  }
  if (const Ident* again = chart_.flag(SfcFlag::Reset)) {
    make_.at(again->loc);
    make_.when(make_.name(again->name), [&] { reset(); });
  }
  make_.at(chart_.pou_.body_begin);
  make_.assign(make_.name("sfc_now"), make_.call("TASK_TIME"));
  const Ident* quit = chart_.flag(SfcFlag::QuitError);
  const Ident* pause = chart_.flag(SfcFlag::Pause);
  if (quit != nullptr || pause != nullptr) stopTime(quit, pause);
  if (quit != nullptr) quitError(*quit);
  if (pause != nullptr) {
    make_.at(pause->loc);
    make_.when(make_.name(pause->name), [&] { make_.leave(); });
  }
  if (chart_.flag(SfcFlag::TipMode) != nullptr) takeTip();
}

// While the chart is paused, its time stops too.
void SfcScheduler::stopTime(const Ident* quit, const Ident* pause) {
  const ExprId waits = make_.name((quit != nullptr ? quit : pause)->name);
  const bool either = quit != nullptr && pause != nullptr;
  make_.when(either ? make_.binary(BinaryOp::Or, waits, make_.name(pause->name)) : waits, [&] {
    const ExprId passed = make_.binary(BinaryOp::Subtract, make_.name("sfc_now"), make_.name("sfc_last"));
    make_.assign(make_.name("sfc_paused"), make_.binary(BinaryOp::Add, make_.name("sfc_paused"), passed));
  });
  make_.assign(make_.name("sfc_last"), make_.name("sfc_now"));
  const ExprId running = make_.binary(BinaryOp::Subtract, make_.name("sfc_now"), make_.name("sfc_paused"));
  make_.assign(make_.name("sfc_now"), running);
}

void SfcScheduler::quitError(const Ident& quit) {
  make_.at(quit.loc);
  make_.when(make_.name(quit.name), [&] {
    if (chart_.flag(SfcFlag::Error) != nullptr) make_.set(flag(SfcFlag::Error), false);
    clearTexts();
    scan(SfcSet::Steps, allMembers, [&](uint32_t i) {
      make_.at(chart_.pou_.body_begin);
      make_.assign(step(chart_.steps_[i], "_t"), make_.name("sfc_now"));
      make_.assign(step(chart_.steps_[i], "t"), make_.noTime());
    });
    make_.leave();
  });
}

// SFCTip fires with its rising edge.
void SfcScheduler::takeTip() {
  const auto tip = [&] { return chart_.flag(SfcFlag::Tip) != nullptr ? flag(SfcFlag::Tip) : make_.boolean(false); };
  make_.assign(make_.name("sfc_tip"), make_.both(tip(), make_.negation(make_.name("sfc_tip_before"))));
  make_.assign(make_.name("sfc_tip_before"), tip());
}

// ---- the time limit of a step

void SfcScheduler::timeLimit(const SfcStep& limited) {
  if (!limited.max.value || chart_.flag(SfcFlag::Error) == nullptr) return;
  make_.at(limited.max.begin);
  ExprId late = make_.binary(BinaryOp::Greater, step(limited, "t"), make_.quote(limited.max.value));
  late = make_.both(late, make_.negation(flag(SfcFlag::Error)));
  if (chart_.flag(SfcFlag::EnableLimit) != nullptr) late = make_.both(late, flag(SfcFlag::EnableLimit));
  make_.when(late, [&] {
    make_.set(flag(SfcFlag::Error), true);
    describeError(limited);
  });
}

void SfcScheduler::describeError(const SfcStep& late) {
  if (chart_.flag(SfcFlag::ErrorStep) != nullptr)
    make_.assign(flag(SfcFlag::ErrorStep), make_.text(chart_.string(late.name.name)));
  if (chart_.flag(SfcFlag::ErrorPou) != nullptr) {
    std::string pou(chart_.string(chart_.pou_.name));
    if (const auto& around = chart_.context_.around; !around.empty())
      pou = std::string(chart_.string(around.back()->name)) + "." + pou;
    make_.assign(flag(SfcFlag::ErrorPou), make_.text(pou));
  }
  if (chart_.flag(SfcFlag::ErrorAnalyzation) != nullptr)
    make_.assign(flag(SfcFlag::ErrorAnalyzation), make_.text(onOneLine(blockingConditions(late))));
  if (chart_.flag(SfcFlag::ErrorAnalyzationTable) != nullptr) fillTable(late);
}

std::vector<const SfcTransition*> SfcScheduler::leaving(const SfcStep& step) const {
  std::vector<const SfcTransition*> out;
  for (const SfcTransition& t : chart_.transitions_)
    for (const Ident& from : tree_.list(t.from))
      if (charts_.names.same(from.name, step.name.name)) out.push_back(&t);
  return out;
}

std::string SfcScheduler::blockingConditions(const SfcStep& step) const {
  std::string all;
  for (const SfcTransition* t : leaving(step)) {
    if (!all.empty()) all += " | ";
    all += t->condition.value && !t->name.name ? chart_.sourceOf({t->condition.begin, t->condition.end})
                                               : chart_.string(t->name.name);
  }
  return all;
}

void SfcScheduler::fillTable(const SfcStep& late) {
  clearTable();
  make_.assign(make_.name("sfc_row"), tableBound("LOWER_BOUND"));
  for (const SfcTransition* t : leaving(late)) {
    make_.at(t->loc);
    const SfcTransition& own = conditionOf(*t);
    if (own.condition.value && !chart_.keepsCondition(own)) {
      analyse(own.condition.value, true);
    } else {
      const NameId name = t->name.name ? t->name.name : own.target.name;
      addRow(make_.name(name), chart_.string(name), true);
    }
  }
}

// Adds a row for each operand that keeps a condition from being `wanted`: of AND those that are FALSE, of OR all if
// none is TRUE, after NOT the other way round.
void SfcScheduler::analyse(ExprId condition, bool wanted) {
  const ExprKind kind = tree_.kind(condition);
  if (kind == ExprKind::Unary && tree_.as<UnaryExpr>(condition).op() == UnaryOp::Not)
    return analyse(tree_.as<UnaryExpr>(condition).operand, !wanted);
  const BinaryOp op = kind == ExprKind::Binary ? tree_.as<BinaryExpr>(condition).op() : BinaryOp::Xor;
  const bool all = op == BinaryOp::And || op == BinaryOp::AndThen;
  if (!all && op != BinaryOp::Or && op != BinaryOp::OrElse)
    return addRow(make_.quote(condition), chart_.sourceOf(tree_.bareRange(condition)), wanted);
  const auto operands = [&] {
    analyse(tree_.as<BinaryExpr>(condition).left, wanted);
    analyse(tree_.as<BinaryExpr>(condition).right, wanted);
  };
  if (all == wanted) return operands();  // one operand is enough to block
  const ExprId holds = make_.inParens(make_.quote(condition));
  make_.when(wanted ? make_.negation(holds) : holds, operands);
}

// Adds a row while there is room for it and the condition is not `wanted`.
void SfcScheduler::addRow(ExprId condition, std::string_view text, bool wanted) {
  const ExprId room = make_.binary(BinaryOp::LessEqual, make_.name("sfc_row"), tableBound("UPPER_BOUND"));
  make_.inParens(condition);
  make_.when(make_.both(room, wanted ? make_.negation(condition) : condition), [&] {
    make_.assign(rowMember("name"), make_.text(onOneLine(text)));
    make_.set(rowMember("value"), !wanted);
    make_.assign(make_.name("sfc_row"), make_.binary(BinaryOp::Add, make_.name("sfc_row"), make_.number(1)));
  });
}

}  // namespace rung::text
