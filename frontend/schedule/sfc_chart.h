// SPDX-License-Identifier: Apache-2.0
// Shared by both parts of the scheduler of charts (see sfc_schedule.h): the chart with its actions and flags, and the
// writer of the generated ST. Private to frontend/schedule: sfc_declare.cpp, sfc_schedule.cpp, sfc_flags.cpp.
#pragma once

#include <optional>
#include <string>

#include "frontend/schedule/sfc_schedule.h"
#include "frontend/syntax/sfc.h"

namespace rung::text {

constexpr uint32_t kWord = 64;  // bits of an LWORD in a set

const char* keywordOf(SfcQualifier q);
inline bool isControlled(SfcQualifier q) { return q < SfcQualifier::Entry; }

std::string literalOf(uint64_t word);
inline std::string maskOf(uint32_t index) { return literalOf(uint64_t{1} << (index % kWord)); }

// Writes ST of which each byte has a location in the chart.
class Writer {
 public:
  Writer(const Charts& charts, Loc loc) : charts_(charts), loc_(loc) {}

  void at(Loc loc) { loc_ = loc; }
  template <class... Parts>
  void line(uint32_t depth, const Parts&... parts) {
    if (depth > 0) put(std::string(2 * depth, ' '));
    (put(parts), ...);
    put("\n");
  }
  void put(std::string_view text) {
    if (segments_.empty() || segments_.back().verbatim || segments_.back().from != loc_)
      segments_.push_back({static_cast<uint32_t>(source_.size()), loc_, false});
    source_ += text;
  }
  void put(const Ident& name) { put(charts_.names.string(name.name)); }
  void put(const SfcExpr& quoted) {
    segments_.push_back({static_cast<uint32_t>(source_.size()), quoted.begin, true});
    source_ += textOf(quoted);
  }
  std::string_view textOf(const SfcExpr& e) const {
    const FileId file = charts_.sources.fileOf(e.begin);
    return charts_.sources.sourceText(file).substr(e.begin.offset - charts_.sources.begin(file).offset,
                                                   e.end.offset - e.begin.offset);
  }
  bool empty() const { return source_.empty(); }
  FileId finish() {
    const FileId file = charts_.sources.fileOf(loc_);
    if (segments_.empty()) segments_.push_back({0, loc_, false});
    const FileId created = charts_.sources.addSourceMapped(std::string(charts_.sources.path(file)), std::move(source_),
                                                           std::move(segments_));
    if (created) charts_.sources.setDisplayPath(created, std::string(charts_.sources.displayPath(file)));
    return created;
  }

 private:
  const Charts& charts_;
  Loc loc_;
  std::string source_;
  std::vector<Segment> segments_;
};

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

// The chart, as both parts of the scheduler see it.
class Chart {
 public:
  Chart(const Charts& charts, const PouDecl& pou, const ChartContext& context);

  std::string_view string(NameId name) const { return charts_.names.string(name); }
  std::string_view name(uint32_t step) const { return string(steps_[step].name.name); }
  uint32_t words(size_t count) const { return static_cast<uint32_t>((count + kWord - 1) / kWord); }
  uint32_t actionOf(NameId name) const;
  const std::string& controlOf(uint32_t action) const { return controls_[action]; }  // the name of its control block
  // Looks up the flags among the variables visible to the chart; until then there are none.
  void findFlags(Signatures& signatures);
  const Ident* flag(SfcFlag word) const {
    const std::optional<Ident>& found = flags_[static_cast<size_t>(word)];
    return found ? &*found : nullptr;
  }
  std::string initialSteps() const;  // the initial values of the step set
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
