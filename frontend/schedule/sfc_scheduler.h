// SPDX-License-Identifier: Apache-2.0
// Makes the statements of a chart; see sfc_schedule.h. Private to frontend/schedule: sfc_schedule.cpp implements the
// cycle, sfc_transitions.cpp its last part, sfc_flags.cpp the flags and the time limits of steps.
#pragma once

#include "frontend/schedule/sfc_builder.h"
#include "frontend/schedule/sfc_chart.h"
#include "frontend/source/function_ref.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

// A set of steps or actions, a bit each.
enum class SfcSet : uint8_t { Steps, Left, Entered, Actions };
constexpr auto allMembers = [](uint32_t) { return true; };

class SfcScheduler {
 public:
  SfcScheduler(const Chart& chart, Signatures& signatures, bool crossed)
      : chart_(chart),
        charts_(chart.charts_),
        tree_(chart.charts_.tree),
        signatures_(signatures),
        make_(chart.charts_.tree, chart.charts_.names),
        crossed_(crossed) {}

  Slice<StmtId> run();

 private:
  // ---- names and sets
  ExprId step(const SfcStep& step, std::string_view member) { return make_.member(make_.name(step.name.name), member); }
  ExprId step(const Ident& step, std::string_view member) { return make_.member(make_.name(step.name), member); }
  ExprId control(uint32_t action) { return make_.name(chart_.controlOf(action)); }
  ExprId control(uint32_t action, std::string_view member) { return make_.member(control(action), member); }
  ExprId flag(SfcFlag flag) { return make_.name(chart_.flag(flag)->name); }
  ExprId element(SfcSet set, ExprId index);
  ExprId currentWord(SfcSet set);
  ExprId wordOf(SfcSet set, uint32_t member);
  void add(SfcSet set, uint32_t member);
  void remove(SfcSet set, uint32_t member);
  size_t sizeOf(SfcSet set) const { return set == SfcSet::Actions ? chart_.actions_.size() : chart_.steps_.size(); }
  Loc locOf(SfcSet set, uint32_t member) const;
  // Visits all LWORDs of a set, each of which is the `currentWord` then.
  void forWords(SfcSet set, FunctionRef<void()> body);
  void clearWords(SfcSet set) { make_.assign(currentWord(set), make_.noBits()); }
  // Visits the members of a set: `wanted` selects those that have a branch.
  void scan(SfcSet set, FunctionRef<bool(uint32_t)> wanted, FunctionRef<void(uint32_t)> branch);

  // ---- the cycle
  bool callsAction(const Ident& action) const { return signatures_.of(action.name).kind != SignatureKind::Value; }
  void run(const SfcStep& step, SfcQualifier when);
  void evolve();
  void enter(const SfcStep& step);
  void activeStep(const SfcStep& step);
  void actions();
  void controlAction(uint32_t action);

  // ---- transitions
  void transitions();
  void leaveStep(uint32_t step, const std::vector<uint32_t>& ways, bool joined);
  void chain(const std::vector<uint32_t>& ways, size_t at);
  bool isPrepared(uint32_t way) const;
  void prepare(uint32_t way);
  ExprId condition(uint32_t way);
  ExprId ownCondition(const SfcTransition& t, bool joins);
  void fire(uint32_t way);
  const SfcTransition& conditionOf(const SfcTransition& t) const;
  std::vector<std::vector<uint32_t>> waysBySteps() const;

  // ---- flags
  void flags();
  void reset();
  void resetWords();
  void clearTexts();
  void clearTable();
  void stopTime(const Ident* quit, const Ident* pause);
  void quitError(const Ident& quit);
  void takeTip();

  // ---- the time limit of a step
  void timeLimit(const SfcStep& step);
  void describeError(const SfcStep& step);
  std::string blockingConditions(const SfcStep& step) const;
  void fillTable(const SfcStep& step);
  void analyse(ExprId condition, bool wanted);
  void addRow(ExprId condition, std::string_view text, bool wanted);
  ExprId tableBound(std::string_view function);
  ExprId rowMember(std::string_view member);
  std::vector<const SfcTransition*> leaving(const SfcStep& step) const;

  const Chart& chart_;
  const Charts& charts_;
  const Tree& tree_;
  Signatures& signatures_;
  SfcBuilder make_;
  bool crossed_;
};

}  // namespace rung::text
