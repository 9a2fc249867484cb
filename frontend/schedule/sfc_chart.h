// SPDX-License-Identifier: Apache-2.0
// The chart with its actions and flags, as both parts of the scheduler see it (see sfc_schedule.h). Private to
// frontend/schedule.
#pragma once

#include <optional>
#include <string>

#include "frontend/schedule/sfc_schedule.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

constexpr uint32_t kWord = 64;  // bits of an LWORD in a set

const char* keywordOf(SfcQualifier q);
inline bool isControlled(SfcQualifier q) { return q < SfcQualifier::Entry; }

inline uint64_t bitOf(uint32_t index) { return uint64_t{1} << (index % kWord); }

// The flags of a chart: declared variables with these names control it. TM/TP manual 5.5.2.5.
enum class SfcFlag : uint8_t {
  Init,
  Reset,
  Error,
  EnableLimit,
  ErrorStep,
  ErrorPou,
  ErrorAnalyzation,
  ErrorAnalyzationTable,
  QuitError,
  Pause,
  Trans,
  CurrentStep,
  TipMode,
  Tip
};
constexpr size_t kSfcFlags = 14;
const char* keywordOf(SfcFlag flag);

class Chart {
 public:
  Chart(const Charts& charts, const PouDecl& pou, const ChartContext& context);

  std::string_view string(NameId name) const { return charts_.names.string(name); }
  uint32_t words(size_t count) const { return static_cast<uint32_t>((count + kWord - 1) / kWord); }
  uint32_t actionOf(NameId name) const;
  const std::string& controlOf(uint32_t action) const { return controls_[action]; }  // the name of its control block
  // Looks up the flags among the variables visible to the chart; until then there are none.
  void findFlags(Signatures& signatures);
  const Ident* flag(SfcFlag word) const {
    const std::optional<Ident>& found = flags_[static_cast<size_t>(word)];
    return found ? &*found : nullptr;
  }
  uint64_t initialSteps(uint32_t word) const;  // those of an LWORD of the set of steps
  std::string_view sourceOf(Range range) const;
  bool keepsCondition(const SfcTransition& t) const { return t.body || (t.name.name && t.condition.value); }

  const Charts& charts_;
  const PouDecl& pou_;
  const ChartContext& context_;
  std::span<const SfcStep> steps_;
  std::span<const SfcTransition> transitions_;
  StepIndex index_;
  std::vector<Ident> actions_;  // with control blocks; codesys: by name, else by first association
  std::vector<std::string> controls_;
  std::vector<std::pair<uint32_t, uint32_t>> action_by_name_;

 private:
  void nameControls();
  std::optional<Ident> flags_[kSfcFlags];
};

}  // namespace rung::text
