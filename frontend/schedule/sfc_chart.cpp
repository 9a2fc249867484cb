// SPDX-License-Identifier: Apache-2.0
#include "frontend/schedule/sfc_chart.h"

#include <algorithm>
#include <unordered_set>

#include "frontend/syntax/sfc.h"

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

const char* keywordOf(SfcQualifier q) {
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

// In the order of the alphabet; `by_name`: the key of each action, with its new number.
static void sortByName(const Names& names, std::vector<Ident>& actions,
                       std::vector<std::pair<uint32_t, uint32_t>>& by_name) {
  std::sort(actions.begin(), actions.end(), [&](const Ident& a, const Ident& b) {
    return foldedIdentifier(names.string(a.name)) < foldedIdentifier(names.string(b.name));
  });
  for (uint32_t i = 0; i < actions.size(); ++i) by_name[i] = {names.key(actions[i].name).index, i};
}

Chart::Chart(const Charts& charts, const PouDecl& pou, const ChartContext& context)
    : charts_(charts),
      pou_(pou),
      context_(context),
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
  // Keeps the first association of each name.
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
  if (charts_.profile.actions_by_name) sortByName(charts_.names, actions, by_name);
  std::sort(by_name.begin(), by_name.end());
  actions_ = std::move(actions);
  action_by_name_ = std::move(by_name);
  nameControls();
}

uint32_t Chart::actionOf(NameId name) const {
  const uint32_t key = charts_.names.key(name).index;
  return std::lower_bound(action_by_name_.begin(), action_by_name_.end(), std::pair<uint32_t, uint32_t>{key, 0})
      ->second;
}

// `_Turn`; of `motor.Turn`: `_motor_Turn`, with a number where another action has that name.
void Chart::nameControls() {
  std::unordered_set<std::string> taken;
  const auto isInstances = [&](const Ident& action) { return string(action.name).find('.') != std::string::npos; };
  for (const Ident& action : actions_)
    if (!isInstances(action)) taken.insert(foldedIdentifier(string(action.name)));
  for (const Ident& action : actions_) {
    std::string name(string(action.name));
    if (isInstances(action)) {
      std::replace(name.begin(), name.end(), '.', '_');
      const size_t length = name.size();
      for (uint32_t i = 2; !taken.insert(foldedIdentifier(name)).second; ++i)
        name.replace(length, std::string::npos, "_" + std::to_string(i));
    }
    controls_.push_back("_" + name);
  }
}

uint64_t Chart::initialSteps(uint32_t word) const {
  uint64_t bits = 0;
  for (uint32_t i = word * kWord; i < steps_.size() && i < (word + 1) * kWord; ++i)
    if (steps_[i].initial) bits |= bitOf(i);
  return bits;
}

std::string_view Chart::sourceOf(Range range) const {
  const FileId file = charts_.sources.fileOf(range.begin);
  const uint32_t base = charts_.sources.begin(file).offset;
  return charts_.sources.sourceText(file).substr(range.begin.offset - base, range.end.offset - range.begin.offset);
}

const char* keywordOf(SfcFlag flag) {
  static const char* const kKeywords[kSfcFlags] = {"SFCInit",
                                                   "SFCReset",
                                                   "SFCError",
                                                   "SFCEnableLimit",
                                                   "SFCErrorStep",
                                                   "SFCErrorPOU",
                                                   "SFCErrorAnalyzation",
                                                   "SFCErrorAnalyzationTable",
                                                   "SFCQuitError",
                                                   "SFCPause",
                                                   "SFCTrans",
                                                   "SFCCurrentStep",
                                                   "SFCTipMode",
                                                   "SFCTip"};
  return kKeywords[static_cast<size_t>(flag)];
}

bool isSfcFlag(std::string_view name) {
  for (size_t i = 0; i < kSfcFlags; ++i)
    if (sameIdentifier(name, keywordOf(static_cast<SfcFlag>(i)))) return true;
  return false;
}

// Flags of a block, inherited and global ones included, act on its own chart or, if its body is not a chart, on the
// charts of its actions. A chart in an action or method of a block with a chart uses only the flags declared in that
// action or method.
void Chart::findFlags(Signatures& signatures) {
  const Tree& tree = charts_.tree;
  for (size_t i = 0; i < kSfcFlags; ++i) {
    const NameId word = charts_.names.find(keywordOf(static_cast<SfcFlag>(i)));
    if (!word) continue;
    for (const DeclId section : tree.list(pou_.sections))
      for (const DeclId var : tree.list(tree.as<SectionDecl>(section).vars))
        for (const Ident& name : tree.list(tree.as<VarDecl>(var).names))
          if (charts_.names.same(name.name, word)) flags_[i] = name;
    const bool sees_block = context_.around.empty() || context_.around.back()->steps.empty();
    if (!flags_[i] && sees_block && signatures.of(word).kind == SignatureKind::Value)
      flags_[i] = Ident{charts_.names.intern(keywordOf(static_cast<SfcFlag>(i))), pou_.body_begin};
  }
}

}  // namespace rung::text
