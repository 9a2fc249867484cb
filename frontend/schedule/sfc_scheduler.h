// SPDX-License-Identifier: Apache-2.0
// Writes the statements of a chart; see sfc_schedule.h. Private to frontend/schedule: sfc_schedule.cpp implements the
// cycle, sfc_flags.cpp the flags and the time limits of steps.
#pragma once

#include "frontend/schedule/sfc_chart.h"
#include "frontend/source/function_ref.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

class SfcScheduler {
 public:
  SfcScheduler(const Chart& chart, Signatures& signatures, Writer& out, bool crossed)
      : chart_(chart),
        charts_(chart.charts_),
        tree_(chart.charts_.tree),
        signatures_(signatures),
        out_(out),
        crossed_(crossed) {}

  void run();

 private:
  using Branch = FunctionRef<void(uint32_t index, uint32_t depth)>;

  std::string word(const char* set, size_t count, uint32_t index) const {
    return chart_.words(count) <= 1 ? set : std::string(set) + "[" + std::to_string(index / kWord) + "]";
  }
  std::string stepWord(const char* set, uint32_t step) const { return word(set, chart_.steps_.size(), step); }
  // Visits all LWORDs of a set.
  void forWords(uint32_t depth, size_t count, FunctionRef<void(const std::string& index, uint32_t depth)> body);
  // Visits the set bits of a set: `wanted` selects the members that have a branch.
  void scan(uint32_t depth, const char* set, size_t count, FunctionRef<bool(uint32_t)> wanted,
            FunctionRef<std::string_view(uint32_t)> name, Branch branch);
  auto stepNames() const {
    return [this](uint32_t i) { return chart_.name(i); };
  }
  auto actionNames() const {
    return [this](uint32_t i) { return chart_.string(chart_.actions_[i].name); };
  }
  bool callsAction(const Ident& action) const { return signatures_.of(action.name).kind != SignatureKind::Value; }
  void run(uint32_t depth, const SfcStep& step, SfcQualifier when);
  void flags();
  void reset(uint32_t depth);
  void evolve();
  void activeStep(uint32_t step, uint32_t depth);
  void timeLimit(const SfcStep& step, uint32_t depth);
  static std::string quoted(std::string_view text);
  std::vector<const SfcTransition*> leaving(const SfcStep& step) const;
  void clearTable(uint32_t depth);
  void analyse(const SfcExpr& e, bool wanted, uint32_t depth);
  template <class Condition>
  void analyseLeaf(const Condition& condition, std::string_view text, bool wanted, uint32_t depth);
  SfcExpr part(const SfcExpr& e) const;
  void actions();
  void transitions();
  void chain(const std::vector<uint32_t>& paths, size_t at, uint32_t depth);
  void condition(uint32_t way);
  void prepare(uint32_t way, uint32_t depth);
  void fire(uint32_t way, uint32_t depth);
  const SfcTransition& conditionOf(const SfcTransition& t) const;
  std::vector<std::vector<uint32_t>> waysBySteps() const;

  const Chart& chart_;
  const Charts& charts_;
  const Tree& tree_;
  Signatures& signatures_;
  Writer& out_;
  bool crossed_;
};

}  // namespace rung::text
